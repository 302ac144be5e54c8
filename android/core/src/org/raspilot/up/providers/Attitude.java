package org.raspilot.up.providers;

/**
 * The aircraft's attitude, in degrees (aerospace convention, as the firmware's).
 *
 * <p>Roll: right wing down is positive, -180 to 180. Pitch: nose up is positive, -90 to 90. Yaw:
 * clockwise from north, 0 to 360 (360 excluded). With the nose straight up or down roll and yaw are
 * one rotation; it is all assigned to yaw, and roll is 0.
 */
public final class Attitude {
    /** Below this cosine of the pitch, roll and yaw cannot be distinguished. */
    private static final double GIMBAL_LOCK = 1e-7;

    /** Degrees, right wing down is positive. */
    public final double rollDeg;
    /** Degrees, nose up is positive. */
    public final double pitchDeg;
    /** Degrees clockwise from north, 0 to 360. */
    public final double yawDeg;

    /** Stores roll and pitch unchanged, and the yaw as 0 to 360. */
    public Attitude(double rollDeg, double pitchDeg, double yawDeg) {
        this.rollDeg = rollDeg;
        this.pitchDeg = pitchDeg;
        this.yawDeg = circle(yawDeg);
    }

    /** Returns the angles of a rotation from aircraft axes (nose, right wing, down) to NED. */
    public static Attitude of(Quaternion bodyToNed) {
        double[] nose = bodyToNed.turn(1, 0, 0);
        double[] wing = bodyToNed.turn(0, 1, 0);
        double[] belly = bodyToNed.turn(0, 0, 1);
        double level = Math.hypot(nose[0], nose[1]);
        double pitch = Math.atan2(-nose[2], level);
        double roll = 0;
        double yaw;
        if (level < GIMBAL_LOCK) {
            yaw = Math.atan2(-wing[0], wing[1]);
        } else {
            roll = Math.atan2(wing[2], belly[2]);
            yaw = Math.atan2(nose[1], nose[0]);
        }
        return new Attitude(Math.toDegrees(roll), Math.toDegrees(pitch), Math.toDegrees(yaw));
    }

    /** Returns the rotation from aircraft axes (nose, right wing, down) to north, east, down. */
    public Quaternion bodyToNed() {
        return Quaternion.about(Math.toRadians(yawDeg), 0, 0, 1)
                .times(Quaternion.about(Math.toRadians(pitchDeg), 0, 1, 0))
                .times(Quaternion.about(Math.toRadians(rollDeg), 1, 0, 0));
    }

    /** Returns the same direction as 0 to 360, 360 excluded. */
    static double circle(double deg) {
        double turned = deg % 360;
        double positive = turned < 0 ? turned + 360 : turned;
        // The sum of a tiny negative angle and 360 is 360.
        return positive >= 360 ? 0 : positive;
    }
}
