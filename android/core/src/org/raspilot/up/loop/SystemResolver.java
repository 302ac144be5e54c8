package org.raspilot.up.loop;

import java.net.Inet4Address;
import java.net.InetAddress;
import java.net.UnknownHostException;
import java.util.ArrayList;
import java.util.List;

/** Queries the system for a name's addresses: IPv4 first, on which the peers listen. */
final class SystemResolver implements NameLookup.Resolver {
    @Override
    public InetAddress[] resolve(String host) throws UnknownHostException {
        final List<InetAddress> others = new ArrayList<>();
        final List<InetAddress> sorted = new ArrayList<>();
        for (InetAddress address : InetAddress.getAllByName(host)) {
            (address instanceof Inet4Address ? sorted : others).add(address);
        }
        sorted.addAll(others);
        return sorted.toArray(new InetAddress[sorted.size()]);
    }
}
