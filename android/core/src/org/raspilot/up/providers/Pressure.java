package org.raspilot.up.providers;

/** The air's pressure where the device is, by its barometer. */
public final class Pressure {
    private final double hPa;

    /** Stores the value unchanged; {@link AltitudeProvider} validates it. */
    public Pressure(double hPa) {
        this.hPa = hPa;
    }

    /** Returns Hectopascal. */
    public double hPa() {
        return hPa;
    }
}
