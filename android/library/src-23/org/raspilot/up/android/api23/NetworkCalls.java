package org.raspilot.up.android.api23;

import android.content.Context;
import android.net.ConnectivityManager;
import android.net.LinkAddress;
import android.net.LinkProperties;
import android.net.Network;
import android.net.NetworkCapabilities;
import android.net.NetworkRequest;
import java.net.InetAddress;
import java.net.UnknownHostException;

/** Monitors networks, and binds the process's sockets to one (API 21 and 23). */
public final class NetworkCalls {
    private NetworkCalls() {
    }

    /**
     * Calls {@code changed} on a thread of the system for each network that appeared, changed or
     * disappeared; returns what stops it, null: the system knows no networks.
     */
    public static Runnable begin(Context context, Runnable changed) {
        final ConnectivityManager manager = manager(context);
        if (manager == null) {
            return null;
        }
        final Calls calls = new Calls(changed);
        // An aeroplane's own access point has no internet.
        manager.registerNetworkCallback(new NetworkRequest.Builder()
                .removeCapability(NetworkCapabilities.NET_CAPABILITY_INTERNET).build(), calls);
        return () -> manager.unregisterNetworkCallback(calls);
    }

    /**
     * Binds the process's future sockets to a Wi-Fi whose network contains an address, null: to
     * any; returns whether there is one.
     */
    public static boolean bindToWifi(Context context, String address) {
        ConnectivityManager manager = manager(context);
        if (manager == null) {
            return false;
        }
        for (Network network : manager.getAllNetworks()) {
            NetworkCapabilities known = manager.getNetworkCapabilities(network);
            boolean isWifi = known != null
                    && known.hasTransport(NetworkCapabilities.TRANSPORT_WIFI);
            if (isWifi && (address == null
                    || holds(manager.getLinkProperties(network), address))) {
                return manager.bindProcessToNetwork(network);
            }
        }
        return false;
    }

    /** Leaves the choice of the network to the system again. */
    public static void release(Context context) {
        ConnectivityManager manager = manager(context);
        if (manager != null) {
            manager.bindProcessToNetwork(null);
        }
    }

    private static ConnectivityManager manager(Context context) {
        return (ConnectivityManager) context.getSystemService(Context.CONNECTIVITY_SERVICE);
    }

    private static boolean holds(LinkProperties properties, String address) {
        if (properties == null) {
            return false;
        }
        try {
            byte[] other = InetAddress.getByName(address).getAddress();
            for (LinkAddress own : properties.getLinkAddresses()) {
                if (Subnet.holds(own.getAddress().getAddress(), own.getPrefixLength(), other)) {
                    return true;
                }
            }
            return false;
        } catch (UnknownHostException none) {
            // A text that is not a numeric address lies in no network.
            return false;
        }
    }

    private static final class Calls extends ConnectivityManager.NetworkCallback {
        private final Runnable changed;

        Calls(Runnable changed) {
            this.changed = changed;
        }

        @Override
        public void onAvailable(Network network) {
            changed.run();
        }

        @Override
        public void onLinkPropertiesChanged(Network network, LinkProperties properties) {
            changed.run();
        }

        @Override
        public void onLost(Network network) {
            changed.run();
        }
    }
}
