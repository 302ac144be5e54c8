package org.raspilot.up.providers;

/** How quickly the device turns about its own axes, by its gyroscope; rad/s, right-handed. */
public final class RotationRate {
    private final double xRadS;
    private final double yRadS;
    private final double zRadS;
    private final long timeMs;

    /** Keeps the values as they are. */
    public RotationRate(double xRadS, double yRadS, double zRadS, long timeMs) {
        this.xRadS = xRadS;
        this.yRadS = yRadS;
        this.zRadS = zRadS;
        this.timeMs = timeMs;
    }

    /** Returns about the axis to the right edge, rad/s. */
    public double xRadS() {
        return xRadS;
    }

    /** Returns about the axis to the top edge, rad/s. */
    public double yRadS() {
        return yRadS;
    }

    /** Returns about the axis out of the screen, rad/s. */
    public double zRadS() {
        return zRadS;
    }

    /** Returns when it was measured, ms of the same clock as the {@link Rotation}'s. */
    public long timeMs() {
        return timeMs;
    }
}
