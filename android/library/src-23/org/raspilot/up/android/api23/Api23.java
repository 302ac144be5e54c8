package org.raspilot.up.android.api23;

import android.app.Activity;
import android.app.PendingIntent;
import android.content.Context;
import android.hardware.Sensor;
import android.hardware.SensorEventListener;
import android.hardware.SensorManager;
import android.location.Location;
import android.os.Handler;
import android.os.PowerManager;
import android.os.SystemClock;
import java.util.concurrent.TimeUnit;

/** Single calls of API 23, and of API 17 and 19, which are reached from 23 on. */
public final class Api23 {
    private Api23() {
    }

    /** Returns the age of a fix, ms; 0 if the system does not report its time. */
    public static long ageMs(Location location) {
        long takenNs = location.getElapsedRealtimeNanos();
        return takenNs <= 0 ? 0
                : TimeUnit.NANOSECONDS.toMillis(SystemClock.elapsedRealtimeNanos() - takenNs);
    }

    /** Starts to listen, without batching; returns whether the system accepted. */
    public static boolean listen(SensorManager sensors, SensorEventListener listener,
            Sensor sensor, int periodUs, Handler handler) {
        return sensors.registerListener(listener, sensor, periodUs, 0, handler);
    }

    /** Returns the flag that prevents other applications from filling in an intent. */
    public static int immutableFlag() {
        return PendingIntent.FLAG_IMMUTABLE;
    }

    /** Shows the system's dialog; the activity's onRequestPermissionsResult receives the answer. */
    public static void requestPermissions(Activity activity, String[] permissions, int request) {
        activity.requestPermissions(permissions, request);
    }

    /** Returns whether the user refused before, so that a reason must precede the next request. */
    public static boolean isReasonDue(Activity activity, String permission) {
        return activity.shouldShowRequestPermissionRationale(permission);
    }

    /** Returns whether the system exempts this application from battery optimizations. */
    public static boolean isSpared(Context context) {
        PowerManager power = (PowerManager) context.getSystemService(Context.POWER_SERVICE);
        return power == null || power.isIgnoringBatteryOptimizations(context.getPackageName());
    }
}
