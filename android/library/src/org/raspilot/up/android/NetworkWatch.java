package org.raspilot.up.android;

import android.content.BroadcastReceiver;
import android.content.Context;
import android.content.Intent;
import android.content.IntentFilter;
import android.net.ConnectivityManager;
import android.os.Build;
import org.raspilot.up.android.api23.NetworkCalls;

/** Tells when the phone's network came back, so that nobody waits for the next attempt. */
final class NetworkWatch extends BroadcastReceiver {
    private final Context context;
    private final boolean isOnWifi;
    private final Runnable came;
    private Runnable end;
    private boolean isReceiving;

    /**
     * Takes whom to tell, on any thread.
     *
     * @param isOnWifi keep the process on Wi-Fi while there is one, from Android 6 on
     */
    NetworkWatch(Context context, boolean isOnWifi, Runnable came) {
        this.context = context.getApplicationContext();
        this.isOnWifi = isOnWifi;
        this.came = came;
    }

    /** Begins to watch; on the main thread. */
    void begin() {
        if (Build.VERSION.SDK_INT >= 23) {
            end = NetworkCalls.begin(context, isOnWifi, came);
        } else {
            isReceiving = true;
            context.registerReceiver(this,
                    new IntentFilter(ConnectivityManager.CONNECTIVITY_ACTION));
        }
    }

    /** Ends it; on the main thread, twice without effect. */
    void end() {
        if (end != null) {
            end.run();
            end = null;
        }
        if (isReceiving) {
            isReceiving = false;
            context.unregisterReceiver(this);
        }
    }

    @Override
    public void onReceive(Context unused, Intent intent) {
        if (!intent.getBooleanExtra(ConnectivityManager.EXTRA_NO_CONNECTIVITY, false)) {
            came.run();
        }
    }
}
