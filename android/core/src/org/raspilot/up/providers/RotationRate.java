package org.raspilot.up.providers;

/** How quickly the device turns about its own axes; rad/s, right-handed. */
public final class RotationRate {
    /** The rate about the axis to the right edge, rad/s. */
    public final double xRadS;
    /** The rate about the axis to the top edge, rad/s. */
    public final double yRadS;
    /** The rate about the axis out of the screen, rad/s. */
    public final double zRadS;
    /** When it was measured, ms of the same clock as the {@link Rotation}'s. */
    public final long timeMs;

    public RotationRate(double xRadS, double yRadS, double zRadS, long timeMs) {
        this.xRadS = xRadS;
        this.yRadS = yRadS;
        this.zRadS = zRadS;
        this.timeMs = timeMs;
    }

    /**
     * Returns the mean rate between two rotations, the later one later: what a device without a
     * gyroscope has.
     */
    public static RotationRate between(Rotation earlier, Rotation later) {
        double seconds = (later.timeMs - earlier.timeMs) / 1000.0;
        Quaternion turn = earlier.deviceToWorld.conjugate().times(later.deviceToWorld);
        double sine = Math.sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
        // A quaternion and its negative are one rotation: the shorter one is meant.
        double angleRad = 2 * Math.atan2(sine, Math.abs(turn.w));
        double scale = sine == 0 ? 0 : Math.copySign(angleRad / sine / seconds, turn.w);
        return new RotationRate(
                turn.x * scale, turn.y * scale, turn.z * scale, later.timeMs);
    }
}
