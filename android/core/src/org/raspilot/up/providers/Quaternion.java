package org.raspilot.up.providers;

/** A quaternion w + xi + yj + zk, Hamilton's; of length one it is a rotation. */
public final class Quaternion {
    public static final Quaternion NONE = new Quaternion(1, 0, 0, 0);

    private static final double MIN_LENGTH = 1e-6;

    /** The real part: of a rotation the cosine of half its angle. */
    public final double w;
    /** The first axis times the sine of half the angle. */
    public final double x;
    /** The second axis times the sine of half the angle. */
    public final double y;
    /** The third axis times the sine of half the angle. */
    public final double z;

    public Quaternion(double w, double x, double y, double z) {
        this.w = w;
        this.x = x;
        this.y = y;
        this.z = z;
    }

    /** Returns the rotation by an angle (rad, right-handed) about an axis of any length but 0. */
    public static Quaternion about(double angleRad, double x, double y, double z) {
        double part = Math.sin(angleRad / 2) / Math.sqrt(x * x + y * y + z * z);
        return new Quaternion(Math.cos(angleRad / 2), x * part, y * part, z * part);
    }

    /** Returns the rotation that turns the three axes into these, orthogonal and of length one. */
    static Quaternion ofAxes(double[] a, double[] b, double[] c) {
        // The greatest of the four is at least one: the rest is taken from it (Shepperd, 1978).
        double fourW = 1 + a[0] + b[1] + c[2];
        double fourX = 1 + a[0] - b[1] - c[2];
        double fourY = 1 - a[0] + b[1] - c[2];
        double fourZ = 1 - a[0] - b[1] + c[2];
        double wx = b[2] - c[1];
        double wy = c[0] - a[2];
        double wz = a[1] - b[0];
        double xy = a[1] + b[0];
        double xz = a[2] + c[0];
        double yz = b[2] + c[1];
        if (fourW >= Math.max(fourX, Math.max(fourY, fourZ))) {
            return new Quaternion(fourW, wx, wy, wz).unit();
        }
        if (fourX >= Math.max(fourY, fourZ)) {
            return new Quaternion(wx, fourX, xy, xz).unit();
        }
        if (fourY >= fourZ) {
            return new Quaternion(wy, xy, fourY, yz).unit();
        }
        return new Quaternion(wz, xz, yz, fourZ).unit();
    }

    /** Returns the rotation of a matrix of nine numbers, row by row, as Android writes it. */
    public static Quaternion ofMatrix(float[] m) {
        return ofAxes(new double[] {m[0], m[3], m[6]}, new double[] {m[1], m[4], m[7]},
                new double[] {m[2], m[5], m[8]});
    }

    /** Returns this times that: as rotations, that one first. */
    public Quaternion times(Quaternion that) {
        return new Quaternion(
                w * that.w - x * that.x - y * that.y - z * that.z,
                w * that.x + x * that.w + y * that.z - z * that.y,
                w * that.y - x * that.z + y * that.w + z * that.x,
                w * that.z + x * that.y - y * that.x + z * that.w);
    }

    /** Returns the conjugate: for a rotation its inverse. */
    public Quaternion conjugate() {
        return new Quaternion(w, -x, -y, -z);
    }

    /** Returns it at length one; raises IllegalArgumentException when it is 0 or not finite. */
    public Quaternion unit() {
        double length = Math.sqrt(w * w + x * x + y * y + z * z);
        if (!(length > MIN_LENGTH) || Double.isInfinite(length)) {
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
