package org.raspilot.up.android;

/** Three values, each through a low pass of first order. On one thread. */
final class LowPass {
    private final double timeConstantMs;
    private final float[] values = new float[3];
    private boolean isKnown;
    private long timeMs;

    LowPass(double timeConstantMs) {
        this.timeConstantMs = timeConstantMs;
    }

    /** Takes the next three values; values that are not numbers are ignored. */
    void update(float[] next, long nowMs) {
        for (int axis = 0; axis < values.length; axis++) {
            if (Float.isNaN(next[axis]) || Float.isInfinite(next[axis])) {
                return;
            }
        }
        double part = isKnown ? part(nowMs - timeMs) : 1;
        for (int axis = 0; axis < values.length; axis++) {
            values[axis] += (float) (part * (next[axis] - values[axis]));
        }
        isKnown = true;
        timeMs = nowMs;
    }

    boolean isKnown() {
        return isKnown;
    }

    /** Returns the smoothed values; they change with the next ones. */
    float[] values() {
        return values;
    }

    private double part(long elapsedMs) {
        return 1 - Math.exp(-Math.max(0, elapsedMs) / timeConstantMs);
    }
}
