package org.raspilot.up.android;

import android.content.Context;
import android.content.pm.PackageManager;
import android.os.Process;

/** What the user permitted; before Android 6 the manifest's permissions are all given. */
public final class Permissions {
    /** Android 13: a notification is shown only with it. Older systems do not know it. */
    public static final String POST_NOTIFICATIONS = "android.permission.POST_NOTIFICATIONS";

    private Permissions() {
    }

    public static boolean has(Context context, String permission) {
        return context.checkPermission(permission, Process.myPid(), Process.myUid())
                == PackageManager.PERMISSION_GRANTED;
    }
}
