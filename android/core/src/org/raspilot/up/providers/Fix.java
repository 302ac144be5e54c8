package org.raspilot.up.providers;

/** The device's position by its GPS; values unknown to the receiver are null. */
public final class Fix {
    /** Degrees north, -90 to 90. */
    public final double latitudeDeg;
    /** Degrees east, -180 to 180. */
    public final double longitudeDeg;
    /** Metres above the ellipsoid or the sea, as the receiver has it; or null. */
    public final Double altitudeM;
    /** Radius in metres in which the device is with 68 percent; or null. */
    public final Double accuracyM;
    /** Metres per second over the ground; or null. */
    public final Double speedMS;
    /** Degrees clockwise from north in which the device moves; or null. */
    public final Double bearingDeg;
    /** Milliseconds from the measurement until the sensor delivered it; or null. */
    public final Double ageMs;
    /** How many satellites the fix uses; or null. */
    public final Integer satellites;

    /** Stores the values unchanged; {@link LocationProvider} validates them. */
    public Fix(double latitudeDeg, double longitudeDeg, Double altitudeM, Double accuracyM,
            Double speedMS, Double bearingDeg, Double ageMs, Integer satellites) {
        this.latitudeDeg = latitudeDeg;
        this.longitudeDeg = longitudeDeg;
        this.altitudeM = altitudeM;
        this.accuracyM = accuracyM;
        this.speedMS = speedMS;
        this.bearingDeg = bearingDeg;
        this.ageMs = ageMs;
        this.satellites = satellites;
    }
}
