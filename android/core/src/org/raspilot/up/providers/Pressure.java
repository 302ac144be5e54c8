package org.raspilot.up.providers;

/** The air pressure at the device, by its barometer. */
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
