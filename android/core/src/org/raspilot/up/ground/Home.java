package org.raspilot.up.ground;

/** The position of the aircraft's home, in degrees. Immutable. */
public final class Home {
    /** The latitude, -90 to 90 degrees. */
    public final double latitudeDeg;
    /** The longitude, -180 to 180 degrees. */
    public final double longitudeDeg;

    Home(double latitudeDeg, double longitudeDeg) {
        this.latitudeDeg = latitudeDeg;
        this.longitudeDeg = longitudeDeg;
    }
}
