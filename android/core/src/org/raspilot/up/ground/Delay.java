package org.raspilot.up.ground;

/**
 * Estimates how much longer than the fastest one a message was in transit, by its sender's clock.
 *
 * <p>The clocks need not be synchronized, so the transit time of the fastest message is not
 * included. The minimum rises only by {@link #DRIFT}, so a queue that stays full for minutes is
 * not taken for transit time: after a time t the estimate is too small by up to 2 t {@link #DRIFT},
 * and never too large. A clock that goes back, or falls behind by {@link #NEW_CLOCK_MS} in one
 * step, is another clock: the estimate is reset.
 */
public final class Delay {
    /** The maximum drift between two clocks: 0.1 ms in a second. */
    public static final double DRIFT = 1e-4;
    /** No message is held up by so much more than the one before: links are given up sooner. */
    public static final double NEW_CLOCK_MS = 30000;

    private boolean hasLeast;
    private boolean hasBegun;
    private double leastMs;
    private double excessMs;
    private double stampMs;
    private double nowMs;

    /** Returns whether the last message was the first of its clock. */
    public boolean hasBegun() {
        return hasBegun;
    }

    /** Resets the estimate, for another clock or another path. */
    public void forget() {
        hasLeast = false;
    }

    /**
     * Takes a message that arrives at {@code arrivalMs}; returns its delay in ms.
     *
     * @param stamp its sender's clock in ms when it was sent; if null, the result is null
     */
    public Double take(Double stamp, double arrivalMs) {
        hasBegun = false;
        if (stamp == null) {
            return null;
        }
        final double apartMs = arrivalMs - stamp;
        if (hasLeast) {
            final double least = Math.min(apartMs, leastMs + DRIFT * (arrivalMs - nowMs));
            final boolean hasJumped = apartMs - least > excessMs + NEW_CLOCK_MS;
            hasLeast = stamp >= stampMs && !hasJumped;
            leastMs = least;
        }
        if (!hasLeast) {
            hasBegun = true;
            hasLeast = true;
            leastMs = apartMs;
        }
        stampMs = stamp;
        nowMs = arrivalMs;
        excessMs = apartMs - leastMs;
        return excessMs;
    }
}
