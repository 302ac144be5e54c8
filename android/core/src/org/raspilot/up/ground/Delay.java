package org.raspilot.up.ground;

/**
 * Tells how much longer than the quickest one a message was on its way, by its sender's clock.
 *
 * <p>The two clocks need not agree on any moment: what even the quickest message took is in no
 * figure. Of the quickest one nothing is forgotten but the drift, so that a queue that stands for
 * minutes is not taken for the length of the way: after a time t the figure is too small by up to
 * 2 t {@link #DRIFT}, and never too great. A clock that goes back, or falls behind by
 * {@link #NEW_CLOCK_MS} at once, is another clock: it begins anew.
 */
public final class Delay {
    /** Two clocks run apart by no more than this: 0.1 ms in a second. */
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

    /** Begins anew, with another clock or another way. */
    public void forget() {
        hasLeast = false;
    }

    /**
     * Takes a message that comes at {@code arrivalMs} and returns by how many ms it was held up.
     *
     * @param stamp its sender's clock in ms when it left; null where none is told: null then
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
