package org.raspilot.up.android;

/** Why a sensor cannot be read on this phone. */
public enum SensorProblem {
    /** The user did not permit the location. */
    LOCATION_PERMISSION,
    /** The phone has neither GPS nor another source of its location. */
    LOCATION,
    /** The location is there and permitted, but switched off in the phone's settings. */
    LOCATION_OFF,
    /** No sensor for the phone's orientation. */
    ROTATION,
    GYROSCOPE,
    BAROMETER,
    /** The system does not report the battery's level. */
    BATTERY,
    /** The system refused to read a sensor that is there. */
    REFUSED,
    SPEECH;

    /** The application's texts for missing parts of a phone. Called on any thread. */
    public interface SensorTexts {
        /** Returns a sentence without a full stop. */
        String of(SensorProblem lack);
    }
}
