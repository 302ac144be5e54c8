package org.raspilot.up.providers;

/** Counts the events of the last second. */
final class RateMeter {
    private static final int MAX_EVENTS = 1024;
    private static final long WINDOW_MS = 1000;

    private final long[] timesMs = new long[MAX_EVENTS];
    private int oldest;
    private int count;

    /** Counts an event; times do not decrease. */
    void count(long nowMs) {
        discardOld(nowMs);
        if (count == MAX_EVENTS) {
            oldest = (oldest + 1) % MAX_EVENTS;
            count--;
        }
        timesMs[(oldest + count) % MAX_EVENTS] = nowMs;
        count++;
    }

    /** Returns the rate over the second that ends now, Hz. */
    double hz(long nowMs) {
        discardOld(nowMs);
        return count;
    }

    private void discardOld(long nowMs) {
        while (count > 0 && nowMs - timesMs[oldest] >= WINDOW_MS) {
            oldest = (oldest + 1) % MAX_EVENTS;
            count--;
        }
    }
}
