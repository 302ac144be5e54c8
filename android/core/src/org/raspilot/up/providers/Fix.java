package org.raspilot.up.providers;

/** The device's position by its GPS; values unknown to the receiver are null. */
public final class Fix {
    private final double latitudeDeg;
    private final double longitudeDeg;
    private final Double altitudeM;
    private final Double accuracyM;
    private final Double speedMS;
    private final Double bearingDeg;

    /** Stores the values unchanged; {@link LocationProvider} validates them. */
    public Fix(
            double latitudeDeg,
            double longitudeDeg,
            Double altitudeM,
            Double accuracyM,
            Double speedMS,
            Double bearingDeg) {
        this.latitudeDeg = latitudeDeg;
        this.longitudeDeg = longitudeDeg;
        this.altitudeM = altitudeM;
        this.accuracyM = accuracyM;
        this.speedMS = speedMS;
        this.bearingDeg = bearingDeg;
    }

    /** Returns degrees north, -90 to 90. */
    public double latitudeDeg() {
        return latitudeDeg;
    }

    /** Returns degrees east, -180 to 180. */
    public double longitudeDeg() {
        return longitudeDeg;
    }

    /** Returns metres above the ellipsoid or the sea, as the receiver has it; or null. */
    public Double altitudeM() {
        return altitudeM;
    }

    /** Returns radius in metres in which the device is with 68 percent; or null. */
    public Double accuracyM() {
        return accuracyM;
    }

    /** Returns metres per second over the ground; or null. */
    public Double speedMS() {
        return speedMS;
    }

    /** Returns degrees clockwise from north in which the device moves; or null. */
    public Double bearingDeg() {
        return bearingDeg;
    }
}
