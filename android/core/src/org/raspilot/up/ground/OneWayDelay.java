package org.raspilot.up.ground;

/**
 * Estimates how much longer than the fastest one a message was in transit, by its sender's clock.
 *
 * <p>The clocks need not be synchronized, so the transit time of the fastest message is not
 * included. The minimum rises only by {@link TelemetrySchema#DRIFT}, so a queue that stays full for minutes is
 * not taken for transit time: after a time t the estimate is too small by up to 2 t {@link TelemetrySchema#DRIFT},
 * and never too large. A clock that goes back, or falls behind by {@link TelemetrySchema#NEW_CLOCK_MS} in one
 * step, is another clock: the estimate is reset.
 */
public final class OneWayDelay {
    private static final double SAME_CLOCK_MS = 1000;

    private boolean isTrusted;
    private boolean hasMinimum;
    private boolean isReset;
    private double leastMs;
    private double excessMs;
    private double stampMs;
    private double nowMs;

    /** Returns whether the last message was the first of its clock. */
    public boolean isReset() {
        return isReset;
    }

    /** Resets the estimate, for another clock or another path. */
    public void reset() {
        hasMinimum = isTrusted;
    }

    /** Returns whether the sender's clock was read authentically. */
    public boolean isTrusted() {
        return isTrusted;
    }

    /**
     * Takes an authentic reading of the sender's clock, made between two times here, ms. From now
     * on only another one counts as a new clock: messages that are held back show it. An estimate
     * that this reading permits stays, so that a slow reading spoils no quick one.
     */
    public void trust(double stamp, double fromMs, double toMs) {
        final double lowMs = fromMs - stamp;
        final double highMs = toMs - stamp;
        final boolean isSame = isTrusted && leastMs > lowMs - SAME_CLOCK_MS
                && leastMs < highMs + SAME_CLOCK_MS;
        final double knownMs = isSame ? leastMs : (lowMs + highMs) / 2;
        leastMs = Math.min(Math.max(knownMs, lowMs), highMs);
        isTrusted = true;
        hasMinimum = true;
        stampMs = stamp;
        nowMs = toMs;
    }

    /**
     * Returns the delay of a message in ms; null without {@code stamp}, its sender's clock in ms.
     */
    public Double update(Double stamp, double arrivalMs) {
        isReset = false;
        if (stamp == null) {
            return null;
        }
        final double apartMs = arrivalMs - stamp;
        if (hasMinimum) {
            final double least = Math.min(apartMs, leastMs + TelemetrySchema.DRIFT * (arrivalMs - nowMs));
            final boolean hasJumped = apartMs - least > excessMs + TelemetrySchema.NEW_CLOCK_MS;
            hasMinimum = isTrusted || stamp >= stampMs && !hasJumped;
            leastMs = least;
        }
        if (!hasMinimum) {
            isReset = true;
            hasMinimum = true;
            leastMs = apartMs;
        }
        stampMs = stamp;
        nowMs = arrivalMs;
        excessMs = apartMs - leastMs;
        return excessMs;
    }
}
