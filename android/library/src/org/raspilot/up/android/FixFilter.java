package org.raspilot.up.android;

/**
 * Drops outdated fixes: systems immediately deliver the last known one, and a busy system delivers
 * late. The first position that the Raspberry Pi receives becomes home.
 */
final class FixFilter {
    /** A fix older than this, ms, is not usable in flight. */
    static final long MAX_AGE_MS = 2000;

    private long knownBeforeMs = Long.MIN_VALUE;

    /** Takes the time (UTC, ms) of the fix that the system knew before the start. */
    void begin(long newestKnownMs) {
        knownBeforeMs = newestKnownMs;
    }

    /** Resets it: the system had no fix. */
    void begin() {
        begin(Long.MIN_VALUE);
    }

    /**
     * Returns whether a fix is current: its age, 0 where unknown, and its own time, UTC, both ms.
     */
    boolean takes(long ageMs, long timeMs) {
        return ageMs <= MAX_AGE_MS && timeMs != knownBeforeMs;
    }
}
