package org.raspilot.up.providers;

/** The air's pressure where the device is, by its barometer. */
public final class Pressure {
    private final double hPa;

    /** Keeps the value as it is; {@link AltitudeProvider} judges it. */
    public Pressure(double hPa) {
        this.hPa = hPa;
    }

    /** Returns Hectopascal. */
    public double hPa() {
        return hPa;
    }
}
