package org.raspilot.up.android;

/**
 * Keeps fixes back that say where the phone was: systems hand out at once the last one that they
 * know, and a busy one hands out late. The first place that the Raspberry Pi hears of is home.
 */
final class FixFilter {
    /** A fix older than this, ms, is none to fly by. */
    static final long OLDEST_MS = 2000;

    private long knownBeforeMs = Long.MIN_VALUE;

    /** Takes the time (UTC, ms) of the fix that the system knew before the start. */
    void begin(long newestKnownMs) {
        knownBeforeMs = newestKnownMs;
    }

    /** Forgets it: the system knew none. */
    void begin() {
        begin(Long.MIN_VALUE);
    }

    /**
     * Says whether a fix tells where the phone is.
     *
     * @param ageMs by the phone's clock; 0 where the system does not tell it
     * @param timeMs the fix's own time, UTC
     */
    boolean takes(long ageMs, long timeMs) {
        return ageMs <= OLDEST_MS && timeMs != knownBeforeMs;
    }
}
