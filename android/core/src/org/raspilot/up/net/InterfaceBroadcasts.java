package org.raspilot.up.net;

import java.net.InterfaceAddress;
import java.net.NetworkInterface;
import java.net.SocketException;
import java.util.ArrayList;
import java.util.Enumeration;
import java.util.List;
import org.raspilot.up.net.DiscoveryClient.BroadcastAddresses;

/** The IPv4 broadcast address of every network interface that is up, by the system's list. */
public final class InterfaceBroadcasts implements BroadcastAddresses {
    private static final String EVERYBODY = "255.255.255.255";

    /** Returns them; if the system reports none, the limited broadcast address. */
    @Override
    public List<String> current() {
        final List<String> found = new ArrayList<>();
        try {
            final Enumeration<NetworkInterface> all = NetworkInterface.getNetworkInterfaces();
            while (all != null && all.hasMoreElements()) {
                addOf(all.nextElement(), found);
            }
        } catch (SocketException error) {
            // An interface disappeared during the query: the addresses found so far are valid.
            return orEverybody(found);
        }
        return orEverybody(found);
    }

    private static void addOf(NetworkInterface each, List<String> found) throws SocketException {
        if (!each.isUp() || each.isLoopback()) {
            return;
        }
        for (InterfaceAddress address : each.getInterfaceAddresses()) {
            if (address != null && address.getBroadcast() != null) {
                final String broadcast = address.getBroadcast().getHostAddress();
                if (!found.contains(broadcast)) {
                    found.add(broadcast);
                }
            }
        }
    }

    private static List<String> orEverybody(List<String> found) {
        if (found.isEmpty()) {
            found.add(EVERYBODY);
        }
        return found;
    }
}
