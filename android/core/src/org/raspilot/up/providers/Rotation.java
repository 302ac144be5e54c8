package org.raspilot.up.providers;

/**
 * The device's orientation in the world: Android's rotation vector as a quaternion.
 *
 * <p>It turns a vector of the device (x to the right edge, y to the top edge, z out of the screen)
 * into east, north, up. Source: Android's documentation of {@code TYPE_ROTATION_VECTOR}.
 */
public final class Rotation {
    /** The unit quaternion, device to east-north-up. */
    public final Quaternion deviceToWorld;
    /** When it was measured, ms of the sensor's or the loop's monotonic clock. */
    public final long timeMs;

    /**
     * Normalizes w, x, y, z to length one; throws IllegalArgumentException if that is impossible.
     */
    public Rotation(double w, double x, double y, double z, long timeMs) {
        this(new Quaternion(w, x, y, z), timeMs);
    }

    /** Normalizes the quaternion to length one; throws IllegalArgumentException if impossible. */
    public Rotation(Quaternion deviceToWorld, long timeMs) {
        this.deviceToWorld = deviceToWorld.unit();
        this.timeMs = timeMs;
    }

    /**
     * Returns the rotation of the values of an Android rotation vector event.
     *
     * @param values x, y, z (each axis times the sine of half the angle) and, optionally, w; older
     *     systems leave it out
     * @throws IllegalArgumentException when they are not a rotation
     */
    public static Rotation ofVector(float[] values, long timeMs) {
        double x = values[0];
        double y = values[1];
        double z = values[2];
        double rest = Math.max(0, 1 - x * x - y * y - z * z);
        return new Rotation(values.length > 3 ? values[3] : Math.sqrt(rest), x, y, z, timeMs);
    }
}
