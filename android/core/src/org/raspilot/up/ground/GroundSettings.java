package org.raspilot.up.ground;

import org.raspilot.up.wire.Hello;
import org.raspilot.up.wire.ProxyRole;
import org.raspilot.up.wire.SafeText;

/** The peer of a ground device and the role it requests; immutable and valid. */
public final class GroundSettings {
    /** The ground port of a Ground Station Proxy. */
    public static final int PROXY_PORT = 3004;
    /** The port of an aircraft's own listener. */
    public static final int DIRECT_PORT = 50002;
    /** The default aircraft of a proxy. */
    public static final String DEFAULT_AIRCRAFT = "default";

    private static final int MAX_HOST_LENGTH = 253;

    /** The name or address of the other side. */
    public final String host;
    public final int port;
    public final String aircraft;
    /** The seat that is requested first, COMMAND or LISTEN. */
    public final ProxyRole role;
    public final boolean isDirect;

    /**
     * Creates settings.
     *
     * @param host a name or address of the proxy or, {@code isDirect}, of the aircraft
     * @param port TCP, 1 to 65535
     * @param aircraft which of the proxy's aircraft, 1 to 32 of {@code A-Z a-z 0-9 _ . -}
     * @param seat COMMAND or LISTEN: the seat to request when the link opens
     * @param isDirect send no hello: an aircraft's listener in the same network
     * @throws IllegalArgumentException with the sentence of {@link #fault}
     */
    public GroundSettings(String host, int port, String aircraft, ProxyRole seat,
            boolean isDirect) {
        final String fault = fault(host, port, aircraft);
        if (fault != null) {
            throw new IllegalArgumentException(fault);
        }
        if (seat != ProxyRole.COMMAND && seat != ProxyRole.LISTEN) {
            throw new IllegalArgumentException("a ground commands or listens");
        }
        this.host = host.trim();
        this.port = port;
        this.aircraft = aircraft;
        this.role = seat;
        this.isDirect = isDirect;
    }

    /** Returns the error of these settings as a sentence, or null if they are valid. */
    public static String fault(String host, int port, String aircraft) {
        final String name = host == null ? "" : host.trim();
        if (name.isEmpty()) {
            return "the host is empty";
        }
        if (name.length() > MAX_HOST_LENGTH || !name.matches("[A-Za-z0-9_.:%-]+")) {
            return "the host is neither a name nor an address: " + SafeText.of(name, 60);
        }
        if (port < 1 || port > 65535) {
            return "the port must be 1 to 65535, not " + port;
        }
        if (!Hello.isAircraftName(aircraft)) {
            return "the aircraft's name must be 1 to 32 letters, digits, '_', '.' or '-'";
        }
        return null;
    }

    /** Returns host and port as people write them. */
    public String address() {
        return host.indexOf(':') >= 0 ? "[" + host + "]:" + port : host + ":" + port;
    }

    /** Returns the key of this aircraft's token in a {@link TokenStore}. */
    public String tokenKey() {
        return host + "_" + port + "_" + aircraft;
    }
}
