package org.raspilot.up.ground;

/** The position of the aircraft's home, in degrees. Immutable. */
public final class Home {
    private final double latitudeDeg;
    private final double longitudeDeg;

    Home(double latitudeDeg, double longitudeDeg) {
        this.latitudeDeg = latitudeDeg;
        this.longitudeDeg = longitudeDeg;
    }

    /** Returns the latitude, -90 to 90 degrees. */
    public double latitudeDeg() {
        return latitudeDeg;
    }

    /** Returns the longitude, -180 to 180 degrees. */
    public double longitudeDeg() {
        return longitudeDeg;
    }
}
