package org.raspilot.up.android;

import android.content.BroadcastReceiver;
import android.content.Context;
import android.content.Intent;
import android.content.IntentFilter;
import android.net.ConnectivityManager;
import android.os.Build;
import org.raspilot.up.android.api23.NetworkCalls;

/** Reports changes of the phone's networks, so that a retry need not wait. */
final class NetworkWatch extends BroadcastReceiver {
    private final Context context;
    private final Runnable came;
    private Runnable end;
    private boolean isReceiving;

    /** Takes the callback, which runs on any thread. */
    NetworkWatch(Context context, Runnable came) {
        this.context = context.getApplicationContext();
        this.came = came;
    }

    /** Starts to watch; on the main thread. */
    void begin() {
        if (Build.VERSION.SDK_INT >= 23) {
            end = NetworkCalls.begin(context, came);
        } else {
            isReceiving = true;
            context.registerReceiver(this,
                    new IntentFilter(ConnectivityManager.CONNECTIVITY_ACTION));
        }
    }

    /** Stops it; on the main thread, later calls have no effect. */
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
