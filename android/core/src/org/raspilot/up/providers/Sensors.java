package org.raspilot.up.providers;

/** The sensors that a device has for flying; one that it lacks is a source that is not present. */
public interface Sensors {
    /** Returns the GPS. */
    SensorSource<Fix> location();

    /** Returns the rotation vector. */
    SensorSource<Rotation> rotation();

    /** Returns the gyroscope. */
    SensorSource<RotationRate> rotationRate();

    /** Returns the barometer. */
    SensorSource<Pressure> pressure();

    /** Returns the battery. */
    SensorSource<BatteryLevel> battery();
}
