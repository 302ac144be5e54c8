package org.raspilot.up.net;

/** The address of a peer: a host, its General Message port and its orientation port. */
public final class Endpoint {
    public final String host;
    public final int generalPort;
    /** The orientation port; 0: absent. */
    public final int orientationPort;

    /**
     * Takes a name or an address and ports of 1 to 65535; {@code orientationPort} 0: absent. Throws
     * IllegalArgumentException with a sentence otherwise.
     */
    public Endpoint(String host, int generalPort, int orientationPort) {
        if (host == null || host.isEmpty()) {
            throw new IllegalArgumentException("the host is empty");
        }
        SettingRules.port("port", generalPort);
        SettingRules.range("orientation port", orientationPort, 0, 65535);
        this.host = host;
        this.generalPort = generalPort;
        this.orientationPort = orientationPort;
    }

    @Override
    public boolean equals(Object other) {
        if (!(other instanceof Endpoint)) {
            return false;
        }
        final Endpoint place = (Endpoint) other;
        return host.equals(place.host) && generalPort == place.generalPort
                && orientationPort == place.orientationPort;
    }

    @Override
    public int hashCode() {
        return (host.hashCode() * 31 + generalPort) * 31 + orientationPort;
    }

    @Override
    public String toString() {
        return host + ":" + generalPort + ":" + orientationPort;
    }
}
