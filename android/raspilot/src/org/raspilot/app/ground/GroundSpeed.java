package org.raspilot.app.ground;

import org.raspilot.up.ground.Earth;

/**
 * Ground speed computed from telemetry's positions: telemetry has no ground speed.
 *
 * <p>Main thread only.
 */
final class GroundSpeed {
    private static final int MAX_FIXES = 16;
    private static final long MAX_MS = 6000;
    private static final long MIN_MS = 400;
    private static final long WINDOW_MS = 2200;
    private static final long JITTER_MS = 50;
    private static final long AGAIN_MS = 300;

    private final double[] latitudesDeg = new double[MAX_FIXES];
    private final double[] longitudesDeg = new double[MAX_FIXES];
    private final long[] timesMs = new long[MAX_FIXES];
    private int count;

    /**
     * Takes a position, degrees, and when it was measured; one repeated in many frames counts once.
     */
    void update(double latitudeDeg, double longitudeDeg, long measuredMs) {
        if (count > 0) {
            long sinceMs = measuredMs - timesMs[count - 1];
            boolean isSame = latitudeDeg == latitudesDeg[count - 1]
                    && longitudeDeg == longitudesDeg[count - 1];
            if (sinceMs < JITTER_MS || sinceMs < AGAIN_MS && isSame) {
                return;
            }
            if (sinceMs > MAX_MS) {
                count = 0;
            }
        }
        if (count == MAX_FIXES) {
            count--;
            System.arraycopy(latitudesDeg, 1, latitudesDeg, 0, count);
            System.arraycopy(longitudesDeg, 1, longitudesDeg, 0, count);
            System.arraycopy(timesMs, 1, timesMs, 0, count);
        }
        latitudesDeg[count] = latitudeDeg;
        longitudesDeg[count] = longitudeDeg;
        timesMs[count] = measuredMs;
        count++;
    }

    void clear() {
        count = 0;
    }

    /** Returns the speed in m/s over about the last two seconds; null: not known. */
    Double metresPerSecond() {
        int last = count - 1;
        int from = 0;
        while (from < last - 1 && timesMs[last] - timesMs[from] > WINDOW_MS) {
            from++;
        }
        long timeMs = last < 1 ? 0 : timesMs[last] - timesMs[from];
        if (timeMs < MIN_MS) {
            return null;
        }
        return 1000 * distanceM(from, last) / timeMs;
    }

    private double distanceM(int from, int to) {
        return Earth.distanceM(latitudesDeg[from], longitudesDeg[from], latitudesDeg[to],
                longitudesDeg[to]);
    }
}
