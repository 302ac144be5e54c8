package org.raspilot.up.android.api29;

import android.app.Notification;
import android.app.Service;
import android.content.pm.ServiceInfo;

/** A foreground service that declares its use of the location (API 29). */
public final class TypedForeground {
    private TypedForeground() {
    }

    /** Brings the service into the foreground; its manifest entry names the type location. */
    public static void start(Service service, int id, Notification notification) {
        service.startForeground(id, notification, ServiceInfo.FOREGROUND_SERVICE_TYPE_LOCATION);
    }
}
