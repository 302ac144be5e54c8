package org.raspilot.up.providers;

import org.raspilot.up.providers.AltitudeProvider.Pressure;
import org.raspilot.up.providers.BatteryProvider.BatteryLevel;

/** The sensors that a device has for flying; one that it lacks is a source that is not present. */
public final class Sensors {
    public final SensorSource<Fix> location;
    public final SensorSource<Rotation> rotation;
    public final SensorSource<RotationRate> rotationRate;
    public final SensorSource<Pressure> pressure;
    public final SensorSource<BatteryLevel> battery;

    public Sensors(SensorSource<Fix> location, SensorSource<Rotation> rotation,
            SensorSource<RotationRate> rotationRate, SensorSource<Pressure> pressure,
            SensorSource<BatteryLevel> battery) {
        this.location = location;
        this.rotation = rotation;
        this.rotationRate = rotationRate;
        this.pressure = pressure;
        this.battery = battery;
    }

    /** Returns the sensors of a device without any. */
    public static Sensors none() {
        return new Sensors(new AbsentSource<>("no GPS"), new AbsentSource<>("no rotation sensor"),
                new AbsentSource<>("no gyroscope"), new AbsentSource<>("no barometer"),
                new AbsentSource<>("no battery"));
    }
}
