package org.raspilot.app;

import android.app.Application;
import android.content.Context;
import android.content.pm.ApplicationInfo;
import android.os.StrictMode;

/** The state of the process: the log and the spawn requests. */
public final class RaspilotApplication extends Application {
    private final AppLog events = new AppLog();
    private SpawnRequests spawning;

    public static RaspilotApplication of(Context context) {
        return (RaspilotApplication) context.getApplicationContext();
    }

    @Override
    public void onCreate() {
        super.onCreate();
        spawning = new SpawnRequests(this);
        boolean isDebug = (getApplicationInfo().flags & ApplicationInfo.FLAG_DEBUGGABLE) != 0;
        if (isDebug) {
            // Makes network access on the main thread fail immediately.
            StrictMode.setThreadPolicy(new StrictMode.ThreadPolicy.Builder()
                    .detectNetwork()
                    .penaltyLog()
                    .penaltyDeathOnNetwork()
                    .build());
        }
    }

    public AppLog events() {
        return events;
    }

    public void log(String sentence) {
        events.add(System.currentTimeMillis(), sentence);
    }

    /** Returns the desk for spawn requests. On the main thread. */
    SpawnRequests spawning() {
        return spawning;
    }
}
