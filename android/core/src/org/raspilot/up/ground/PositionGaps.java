package org.raspilot.up.ground;

import java.util.Arrays;

/** Detects gaps in the known positions; the track has no line across a gap. */
final class PositionGaps {
    /** A longer time without a position, ms, is a gap, unless positions have a longer period. */
    private static final long GAP_MS = 900;
    private static final double PERIODS = 2.5;
    private static final int INTERVALS = 5;

    private final long[] intervalsMs = new long[INTERVALS];
    private int intervals;
    private Long knownMs;

    /** Takes a known position; returns whether it ends a gap. */
    boolean update(long nowMs) {
        final Long beforeMs = knownMs;
        knownMs = nowMs;
        if (beforeMs == null) {
            return false;
        }
        final double periodMs = periodMs();
        intervalsMs[intervals % INTERVALS] = nowMs - beforeMs;
        intervals++;
        return nowMs - beforeMs > Math.max(GAP_MS, PERIODS * periodMs);
    }

    /** Returns the median time between the last positions; 0: unknown. */
    private double periodMs() {
        if (intervals < INTERVALS) {
            return 0;
        }
        final long[] sorted = intervalsMs.clone();
        Arrays.sort(sorted);
        return sorted[INTERVALS / 2];
    }
}
