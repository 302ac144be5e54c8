package org.raspilot.up.net;

import java.util.Random;

/** Waits between attempts that double up to a bound, each varied by up to 20 percent. */
final class BackOff {
    private static final double JITTER = 0.2;

    private final int firstMs;
    private final int lastMs;
    private final Random random;
    private int nextMs;

    BackOff(int firstMs, int lastMs, Random random) {
        this.firstMs = firstMs;
        this.lastMs = lastMs;
        this.random = random;
        nextMs = firstMs;
    }

    void reset() {
        nextMs = firstMs;
    }

    /**
     * Returns the wait after an attempt that took {@code tookMs}. The duration of the attempt
     * counts as part of the wait, except for a remainder of the shortest wait, because an attempt
     * that timed out has waited already.
     */
    long nextWaitMs(long tookMs) {
        final double factor = 1 - JITTER + 2 * JITTER * random.nextDouble();
        final long waitMs = Math.round(nextMs * factor);
        nextMs = (int) Math.min(lastMs, nextMs * 2L);
        return Math.max(Math.min(firstMs, waitMs), waitMs - tookMs);
    }
}
