package org.raspilot.up.providers;

/** Sends what the Battery sensor reads. */
public final class BatteryProvider extends UpProvider {
    /** The name under which it is registered. */
    public static final String NAME = "battery";

    /** Takes the sensor. */
    public BatteryProvider(SensorSource<BatteryLevel> source) {
        super(NAME);
    }
}
