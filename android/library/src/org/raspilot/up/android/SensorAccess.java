package org.raspilot.up.android;

import android.content.Context;
import android.hardware.Sensor;
import android.hardware.SensorEventListener;
import android.hardware.SensorManager;
import android.os.Build;
import android.os.Handler;
import android.os.Looper;
import org.raspilot.up.android.api23.Api23;

/** The phone's built-in sensors: finds them and listens to them, at 200 Hz at most. */
final class SensorAccess {
    /** Android 12 requires a separate permission for shorter periods. */
    static final int MIN_PERIOD_US = 5000;

    private static final int MAX_PERIOD_US = 10000000;
    private static final int US_IN_MS = 1000;

    private final SensorManager sensors;
    private final Handler handler;

    /** Takes the thread on which the sensors' listeners are called. */
    SensorAccess(Context context, Looper looper) {
        sensors = (SensorManager) context.getSystemService(Context.SENSOR_SERVICE);
        handler = new Handler(looper);
    }

    /** Returns the phone's sensor of a type of {@link Sensor}, or null. */
    Sensor find(int type) {
        return sensors == null ? null : sensors.getDefaultSensor(type);
    }

    /** Starts to listen; returns whether the system accepted. */
    boolean register(SensorEventListener listener, Sensor sensor, long periodMs) {
        int periodUs = periodUs(periodMs);
        if (Build.VERSION.SDK_INT >= 23) {
            return Api23.listen(sensors, listener, sensor, periodUs, handler);
        }
        return sensors.registerListener(listener, sensor, periodUs, handler);
    }

    void unregister(SensorEventListener listener) {
        if (sensors != null) {
            sensors.unregisterListener(listener);
        }
    }

    /** Returns the period in us, within what every system permits. */
    static int periodUs(long periodMs) {
        return (int) Math.max(MIN_PERIOD_US, Math.min(MAX_PERIOD_US, periodMs * US_IN_MS));
    }
}
