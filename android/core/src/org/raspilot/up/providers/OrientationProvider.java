package org.raspilot.up.providers;

/** Sends the aircraft's attitude and rates as Orientation Forward frames (protocols 3). */
public final class OrientationProvider extends UpProvider {
    /** The name under which it is registered. */
    public static final String NAME = "orientation";

    /** Takes both sensors, the mounting and the rate, 50 to 200 Hz. */
    public OrientationProvider(
            SensorSource<Rotation> rotation,
            SensorSource<RotationRate> rotationRate,
            Mounting mounting,
            int rateHz) {
        super(NAME);
    }

    /** Takes another mounting, as after a calibration. */
    public void setMounting(Mounting mounting) {}

    /** Takes the angle from magnetic to true north, degrees, east positive. */
    public void setDeclinationDeg(double declinationDeg) {}

    /** Returns the newest rotation, or null: what {@link Mounting#level} wants. */
    public Rotation newestRotation() {
        return null;
    }
}
