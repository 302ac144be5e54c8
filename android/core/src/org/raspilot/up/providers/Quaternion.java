package org.raspilot.up.providers;

/** A quaternion w + xi + yj + zk, Hamilton's; of length one it is a rotation. */
public final class Quaternion {
    /** No rotation at all. */
    public static final Quaternion NONE = new Quaternion(1, 0, 0, 0);

    private static final double SMALLEST = 1e-6;

    /** The real part: the cosine of half the angle. */
    public final double w;
    /** The first axis times the sine of half the angle. */
    public final double x;
    /** The second axis times the sine of half the angle. */
    public final double y;
    /** The third axis times the sine of half the angle. */
    public final double z;

    /** Keeps the four parts as they are. */
    public Quaternion(double w, double x, double y, double z) {
        this.w = w;
        this.x = x;
        this.y = y;
        this.z = z;
    }

    /** Returns the rotation by an angle (rad, right-handed) about an axis of any length but zero. */
    public static Quaternion about(double angleRad, double x, double y, double z) {
        double length = Math.sqrt(x * x + y * y + z * z);
        double part = Math.sin(angleRad / 2) / length;
        return new Quaternion(Math.cos(angleRad / 2), x * part, y * part, z * part);
    }

    /** Returns this times that: as rotations, that one first. */
    public Quaternion times(Quaternion that) {
        return new Quaternion(
                w * that.w - x * that.x - y * that.y - z * that.z,
                w * that.x + x * that.w + y * that.z - z * that.y,
                w * that.y - x * that.z + y * that.w + z * that.x,
                w * that.z + x * that.y - y * that.x + z * that.w);
    }

    /** Returns the way back: for a rotation its inverse. */
    public Quaternion conjugate() {
        return new Quaternion(w, -x, -y, -z);
    }

    /** Returns it at length one; raises IllegalArgumentException when it is zero or not finite. */
    public Quaternion unit() {
        double length = Math.sqrt(w * w + x * x + y * y + z * z);
        if (!(length > SMALLEST) || Double.isInfinite(length)) {
            throw new IllegalArgumentException("no rotation: a quaternion of length " + length);
        }
        return new Quaternion(w / length, x / length, y / length, z / length);
    }

    /** Returns the vector (three numbers) turned by this rotation. */
    public double[] turn(double vectorX, double vectorY, double vectorZ) {
        Quaternion turned =
                times(new Quaternion(0, vectorX, vectorY, vectorZ)).times(conjugate());
        return new double[] {turned.x, turned.y, turned.z};
    }
}
