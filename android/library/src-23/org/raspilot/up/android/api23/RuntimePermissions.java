package org.raspilot.up.android.api23;

import android.app.Activity;
import android.content.Context;
import android.os.PowerManager;

/** Run-time permissions, and the system's battery optimisation (API 23). */
public final class RuntimePermissions {
    private RuntimePermissions() {
    }

    /** Shows the system's dialog; the activity's onRequestPermissionsResult receives the answer. */
    public static void forPermissions(Activity activity, String[] permissions, int request) {
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
