package org.raspilot.up.android;

import android.content.Context;
import android.net.wifi.WifiManager;
import android.os.PowerManager;

/** Keeps processor and Wi-Fi awake while the screen is off. On the main thread. */
final class AwakeLocks {
    private static final String TAG = "raspilot:up";

    private final PowerManager.WakeLock processor;
    private final WifiManager.WifiLock wifi;

    AwakeLocks(Context context) {
        Context lasting = context.getApplicationContext();
        PowerManager power = (PowerManager) lasting.getSystemService(Context.POWER_SERVICE);
        processor = power.newWakeLock(PowerManager.PARTIAL_WAKE_LOCK, TAG);
        processor.setReferenceCounted(false);
        WifiManager manager = (WifiManager) lasting.getSystemService(Context.WIFI_SERVICE);
        wifi = manager == null ? null
                : manager.createWifiLock(WifiManager.WIFI_MODE_FULL_HIGH_PERF, TAG);
        if (wifi != null) {
            wifi.setReferenceCounted(false);
        }
    }

    /** Acquires both; without a timeout, because a flight has none. */
    void acquire() {
        processor.acquire();
        if (wifi != null) {
            wifi.acquire();
        }
    }

    /** Gives both back; twice without effect. */
    void release() {
        if (processor.isHeld()) {
            processor.release();
        }
        if (wifi != null && wifi.isHeld()) {
            wifi.release();
        }
    }
}
