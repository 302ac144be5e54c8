package org.raspilot.up.providers;

/** Sends what the Altitude sensor reads. */
public final class AltitudeProvider extends UpProvider {
    /** The name under which it is registered. */
    public static final String NAME = "altitude";

    /** Takes the sensor. */
    public AltitudeProvider(SensorSource<Pressure> source) {
        super(NAME);
    }
}
