package org.raspilot.up.providers;

/** The sensors that a device has for flying; one that it lacks is a source that is not present. */
public interface Sensors {
    SensorSource<Fix> location();

    SensorSource<Rotation> rotation();

    SensorSource<RotationRate> rotationRate();

    SensorSource<Pressure> pressure();

    SensorSource<BatteryLevel> battery();
}
