package org.raspilot.up.android.api23;

import android.content.Context;
import android.net.ConnectivityManager;
import android.net.Network;
import android.net.NetworkCapabilities;
import android.net.NetworkRequest;

/**
 * Hears of networks that come (API 21, reached from 23 on), and keeps the process on Wi-Fi where
 * that is wanted: a system prefers its mobile network to a Wi-Fi without internet, on which
 * an aeroplane's own access point would never be reached.
 */
public final class NetworkCalls {
    private NetworkCalls() {
    }

    /**
     * Begins to hear.
     *
     * @param isOnWifi keep every socket of the process on Wi-Fi while there is one
     * @param came called on a thread of the system for each network that came or changed
     * @return what ends it, on any thread; null: the system knows no networks
     */
    public static Runnable begin(Context context, boolean isOnWifi, Runnable came) {
        ConnectivityManager manager = (ConnectivityManager)
                context.getSystemService(Context.CONNECTIVITY_SERVICE);
        if (manager == null) {
            return null;
        }
        final Calls calls = new Calls(manager, isOnWifi, came);
        NetworkRequest.Builder wanted = new NetworkRequest.Builder()
                .removeCapability(NetworkCapabilities.NET_CAPABILITY_INTERNET);
        if (isOnWifi) {
            wanted.addTransportType(NetworkCapabilities.TRANSPORT_WIFI);
        }
        manager.registerNetworkCallback(wanted.build(), calls);
        return new Runnable() {
            @Override
            public void run() {
                calls.end();
            }
        };
    }

    private static final class Calls extends ConnectivityManager.NetworkCallback {
        private final ConnectivityManager manager;
        private final boolean isOnWifi;
        private final Runnable came;
        private final Object lock = new Object();
        private Network bound;
        private boolean isEnded;

        Calls(ConnectivityManager manager, boolean isOnWifi, Runnable came) {
            this.manager = manager;
            this.isOnWifi = isOnWifi;
            this.came = came;
        }

        @Override
        public void onAvailable(Network network) {
            synchronized (lock) {
                if (isEnded) {
                    return;
                }
                if (isOnWifi && manager.bindProcessToNetwork(network)) {
                    bound = network;
                }
            }
            came.run();
        }

        @Override
        public void onLost(Network network) {
            synchronized (lock) {
                if (isEnded || !network.equals(bound)) {
                    return;
                }
                unbind();
            }
            came.run();
        }

        void end() {
            synchronized (lock) {
                isEnded = true;
                unbind();
            }
            manager.unregisterNetworkCallback(this);
        }

        private void unbind() {
            if (bound != null) {
                bound = null;
                manager.bindProcessToNetwork(null);
            }
        }
    }
}
