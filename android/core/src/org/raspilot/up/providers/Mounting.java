package org.raspilot.up.providers;

/**
 * How the device lies in the aeroplane: the rotation from aircraft axes (nose, right wing, down) to
 * device axes (right edge, top edge, out of the screen).
 */
public final class Mounting {
    /** The screen up and the top edge to the nose. */
    public static final Mounting FLAT = new Mounting(Quaternion.NONE);

    private final Quaternion bodyToDevice;

    /** Takes any rotation; raises IllegalArgumentException for a quaternion that is none. */
    public Mounting(Quaternion bodyToDevice) {
        this.bodyToDevice = bodyToDevice.unit();
    }

    /** Returns the rotation from aircraft axes to device axes. */
    public Quaternion bodyToDevice() {
        return bodyToDevice;
    }

    /**
     * Returns the mounting for which this rotation is level: roll and pitch zero, and the nose where
     * the named side of the device points.
     *
     * @throws IllegalArgumentException when that side points up or down (a sentence for the user)
     */
    public static Mounting level(Rotation rotation, Nose nose) {
        throw new UnsupportedOperationException();
    }

    /** Returns the aircraft's attitude; declinationDeg (east positive) turns magnetic to true north. */
    public Attitude attitude(Rotation rotation, double declinationDeg) {
        throw new UnsupportedOperationException();
    }

    /** Returns the aircraft's roll, pitch and yaw rate about its own axes, deg/s. */
    public double[] ratesDegS(RotationRate rate) {
        throw new UnsupportedOperationException();
    }

    /** Returns it as text for settings: four numbers, {@code w x y z}. */
    public String toText() {
        throw new UnsupportedOperationException();
    }

    /** Returns the mounting of {@link #toText}; raises IllegalArgumentException with a sentence. */
    public static Mounting fromText(String text) {
        throw new UnsupportedOperationException();
    }
}
