package org.raspilot.up.android;

import android.content.Context;
import android.os.Build;
import org.raspilot.up.android.api23.NetworkCalls;

/** The process's sockets and the phone's Wi-Fi, from Android 6 on. */
final class ProcessWifi implements WifiBinding.Wifi {
    private final Context context;

    ProcessWifi(Context context) {
        this.context = context.getApplicationContext();
    }

    @Override
    public boolean bind(String address) {
        return Build.VERSION.SDK_INT >= 23 && NetworkCalls.bindToWifi(context, address);
    }

    @Override
    public void release() {
        if (Build.VERSION.SDK_INT >= 23) {
            NetworkCalls.release(context);
        }
    }
}
