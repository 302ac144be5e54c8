package org.raspilot.up.providers;

/** Sends what the Location sensor reads. */
public final class LocationProvider extends UpProvider {
    /** The name under which it is registered. */
    public static final String NAME = "location";

    /** Takes the sensor. */
    public LocationProvider(SensorSource<Fix> source) {
        super(NAME);
    }
}
