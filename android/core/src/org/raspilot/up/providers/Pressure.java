package org.raspilot.up.providers;

/** The air pressure at the device, by its barometer. */
public final class Pressure {
    /** Hectopascal. */
    public final double hPa;

    /** Stores the value unchanged; {@link AltitudeProvider} validates it. */
    public Pressure(double hPa) {
        this.hPa = hPa;
    }
}
