package org.raspilot.up.android;

/** Measures how long the phone has slept, by two clocks of which one stops during sleep. */
final class SleepCount {
    private long mostMs;

    /**
     * Returns the time slept since boot, ms: never decreasing, and at most 1 ms too much.
     *
     * @param allMs of the clock that counts sleep; read it first, so that time between the two
     *     readings is not taken for sleep
     * @param awakeMs of the one that does not
     */
    synchronized long totalMs(long allMs, long awakeMs) {
        mostMs = Math.max(mostMs, allMs - awakeMs);
        return mostMs;
    }
}
