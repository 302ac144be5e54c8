package org.raspilot.up.providers;

/** How often a provider sends, and the maximum age of its readings; times in ms. */
public final class RatePolicy {
    /** A reading older than this number of periods is not sent. */
    private static final int MAX_AGE_PERIODS = 2;

    /** How much of a period a message may leave sooner or later than it is due. */
    private static final double TOLERANCE_PERIODS = 0.25;

    /** The shortest time between two messages. */
    final double periodMs;
    /** After how long the same is sent again; 0: never. */
    final long repeatMs;
    /** How old a reading may be when it is sent. */
    final long maxAgeMs;
    /** The time without a reading after which the sensor counts as silent. */
    final long silenceLimitMs;

    private RatePolicy(double periodMs, long repeatMs, long maxAgeMs, long silenceLimitMs) {
        if (!(periodMs > 0) || silenceLimitMs <= 0) {
            throw new IllegalArgumentException("periods and limits are more than 0 ms");
        }
        this.periodMs = periodMs;
        this.repeatMs = repeatMs;
        this.maxAgeMs = maxAgeMs;
        this.silenceLimitMs = silenceLimitMs;
    }

    /**
     * Returns the cadence of a value that changes continuously: each reading is sent once, while it
     * is fresh, at most one in a period.
     */
    public static RatePolicy stream(double periodMs, long silenceLimitMs) {
        return new RatePolicy(
                periodMs, 0, (long) Math.ceil(MAX_AGE_PERIODS * periodMs), silenceLimitMs);
    }

    /**
     * Returns the cadence of a value that holds until it changes, such as a battery's level: sent
     * on each change and repeated, because the sensor reports only changes.
     *
     * @param leastMs the shortest time between two messages
     * @param repeatMs the period of repetition
     * @param silenceLimitMs how long the first reading may take before the sensor counts as silent
     */
    public static RatePolicy level(double leastMs, long repeatMs, long silenceLimitMs) {
        return new RatePolicy(leastMs, repeatMs, Long.MAX_VALUE, silenceLimitMs);
    }

    /** Returns how much sooner or later than it is due a message may leave to be fresh. */
    double toleranceMs() {
        return isLevel() ? 0 : TOLERANCE_PERIODS * periodMs;
    }

    /** Returns whether the value holds until it changes. */
    boolean isLevel() {
        return repeatMs > 0;
    }
}
