package org.raspilot.up.providers;

/** Counts the events of the last second. */
final class RateMeter {
    private static final int MOST = 1024;
    private static final long WINDOW_MS = 1000;

    private final long[] timesMs = new long[MOST];
    private int oldest;
    private int count;

    /** Counts an event; times do not decrease. */
    void happened(long nowMs) {
        forget(nowMs);
        if (count == MOST) {
            oldest = (oldest + 1) % MOST;
            count--;
        }
        timesMs[(oldest + count) % MOST] = nowMs;
        count++;
    }

    /** Returns the rate over the second that ends now, Hz. */
    double hz(long nowMs) {
        forget(nowMs);
        return count;
    }

    private void forget(long nowMs) {
        while (count > 0 && nowMs - timesMs[oldest] >= WINDOW_MS) {
            oldest = (oldest + 1) % MOST;
            count--;
        }
    }
}
