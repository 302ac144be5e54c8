package org.raspilot.up.providers;

import org.raspilot.up.wire.SafeText;

/**
 * The device's mounting in the aeroplane: the rotation from aircraft axes (nose, right wing, down)
 * to device axes (right edge, top edge, out of the screen). Any orientation is allowed.
 */
public final class Mounting {
    private static final int MAX_SHOWN_LENGTH = 80;

    /** The screen up and the top edge to the nose. */
    public static final Mounting FLAT = of(Side.TOP, Side.SCREEN);

    /** Half a turn about the line to the north-east swaps NED and Android's east-north-up. */
    private static final Quaternion SWAP_NED_ENU = Quaternion.about(Math.PI, 1, 1, 0);

    /** When calibrated, the side at the nose may point up or down by at most 60 degrees. */
    private static final double MIN_LEVEL = 0.5;

    /** The rotation from aircraft axes to device axes. */
    public final Quaternion bodyToDevice;

    /** Takes any rotation; throws IllegalArgumentException for an invalid quaternion. */
    public Mounting(Quaternion bodyToDevice) {
        this.bodyToDevice = bodyToDevice.unit();
    }

    /**
     * Returns the mounting with one side of the device to the nose and another one up.
     *
     * @throws IllegalArgumentException when both lie on one line (a sentence)
     */
    public static Mounting of(Side nose, Side up) {
        if (nose.x() * up.x() + nose.y() * up.y() + nose.z() * up.z() != 0) {
            throw new IllegalArgumentException(
                    "one side cannot be ahead while it or its opposite is up");
        }
        double[] ahead = {nose.x(), nose.y(), nose.z()};
        double[] down = {-up.x(), -up.y(), -up.z()};
        return new Mounting(Quaternion.ofAxes(ahead, cross(down, ahead), down));
    }

    /**
     * Returns the mounting for which this rotation is level: roll and pitch are zero, and the named
     * side of the device points to the nose.
     *
     * @throws IllegalArgumentException when that side points up or down (a sentence)
     */
    public static Mounting level(Rotation rotation, Side nose) {
        Quaternion deviceToNed = SWAP_NED_ENU.times(rotation.deviceToWorld);
        double[] ahead = deviceToNed.turn(nose.x(), nose.y(), nose.z());
        if (Math.hypot(ahead[0], ahead[1]) < MIN_LEVEL) {
            throw new IllegalArgumentException("the side that is to be at the nose points "
                    + (ahead[2] < 0 ? "up" : "down") + ": hold the aeroplane level");
        }
        Quaternion bodyToNed =
                Quaternion.about(Math.atan2(ahead[1], ahead[0]), 0, 0, 1);
        return new Mounting(deviceToNed.conjugate().times(bodyToNed));
    }

    /**
     * Returns the aircraft's attitude; the declination is from magnetic to true north, deg, east
     * positive.
     */
    public Attitude attitude(Rotation rotation, double declinationDeg) {
        Attitude magnetic = Attitude.of(
                SWAP_NED_ENU.times(rotation.deviceToWorld).times(bodyToDevice));
        return new Attitude(
                magnetic.rollDeg, magnetic.pitchDeg, magnetic.yawDeg + declinationDeg);
    }

    /** Returns the rotation that a device mounted so has in an aircraft of this attitude. */
    public Rotation rotation(Attitude attitude, long timeMs) {
        Quaternion deviceToNed = attitude.bodyToNed().times(bodyToDevice.conjugate());
        return new Rotation(SWAP_NED_ENU.times(deviceToNed), timeMs);
    }

    /** Returns the aircraft's roll, pitch and yaw rate about its own axes, deg/s. */
    public double[] ratesDegS(RotationRate rate) {
        double[] rates =
                bodyToDevice.conjugate().turn(rate.xRadS, rate.yRadS, rate.zRadS);
        for (int axis = 0; axis < rates.length; axis++) {
            rates[axis] = Math.toDegrees(rates[axis]);
        }
        return rates;
    }

    /** Returns it as text for settings: four numbers, {@code w x y z}. */
    public String toText() {
        return bodyToDevice.w + " " + bodyToDevice.x + " " + bodyToDevice.y + " "
                + bodyToDevice.z;
    }

    /**
     * Returns the mounting of {@link #toText}.
     *
     * @throws IllegalArgumentException with a sentence when the text is not a mounting
     */
    public static Mounting fromText(String text) {
        String[] parts = text.trim().split("\\s+");
        if (parts.length != 4) {
            throw new IllegalArgumentException(
                    "the mounting is four numbers, not '" + SafeText.of(text, MAX_SHOWN_LENGTH)
                            + "'");
        }
        try {
            return new Mounting(new Quaternion(
                    Double.parseDouble(parts[0]),
                    Double.parseDouble(parts[1]),
                    Double.parseDouble(parts[2]),
                    Double.parseDouble(parts[3])));
        } catch (IllegalArgumentException error) {
            throw new IllegalArgumentException(
                    "the mounting '" + SafeText.of(text, MAX_SHOWN_LENGTH) + "' is not a rotation",
                            error);
        }
    }

    private static double[] cross(double[] a, double[] b) {
        return new double[] {
            a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
        };
    }
}
