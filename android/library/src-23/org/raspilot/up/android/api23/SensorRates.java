package org.raspilot.up.android.api23;

import android.hardware.Sensor;
import android.hardware.SensorEventListener;
import android.hardware.SensorManager;
import android.os.Handler;

/** Sensors whose readings are not batched (API 19, reached from 23 on). */
public final class SensorRates {
    private SensorRates() {
    }

    /** Starts to listen, without batching; returns whether the system accepted. */
    public static boolean listen(SensorManager sensors, SensorEventListener listener,
            Sensor sensor, int periodUs, Handler handler) {
        return sensors.registerListener(listener, sensor, periodUs, 0, handler);
    }
}
