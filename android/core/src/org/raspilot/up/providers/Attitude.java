package org.raspilot.up.providers;

/**
 * How the aircraft lies in the world, in degrees (aerospace convention, as the firmware's).
 *
 * <p>Roll: right wing down is positive, -180 to 180. Pitch: nose up is positive, -90 to 90. Yaw:
 * clockwise from north, 0 to 360 (360 excluded).
 */
public final class Attitude {
    private final double rollDeg;
    private final double pitchDeg;
    private final double yawDeg;

    /** Keeps the three angles as they are. */
    public Attitude(double rollDeg, double pitchDeg, double yawDeg) {
        this.rollDeg = rollDeg;
        this.pitchDeg = pitchDeg;
        this.yawDeg = yawDeg;
    }

    /** Returns the angles of a rotation from aircraft axes (nose, right wing, down) to north-east-down. */
    public static Attitude of(Quaternion bodyToNed) {
        throw new UnsupportedOperationException();
    }

    /** Returns the rotation from aircraft axes (nose, right wing, down) to north-east-down. */
    public Quaternion bodyToNed() {
        throw new UnsupportedOperationException();
    }

    /** Returns degrees, right wing down is positive. */
    public double rollDeg() {
        return rollDeg;
    }

    /** Returns degrees, nose up is positive. */
    public double pitchDeg() {
        return pitchDeg;
    }

    /** Returns degrees clockwise from north. */
    public double yawDeg() {
        return yawDeg;
    }
}
