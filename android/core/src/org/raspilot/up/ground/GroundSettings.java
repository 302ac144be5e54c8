package org.raspilot.up.ground;

import org.raspilot.up.net.SettingRules;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.tls.TlsIdentity;
import org.raspilot.up.wire.ProxyRole;

/** The peer of a ground device and the role it requests; immutable and valid. */
public final class GroundSettings {
    public static final int PROXY_PORT = 3004;

    /** The name or address of the other side. */
    public final String host;
    public final int port;
    public final String aircraft;
    /** The seat that is requested first, COMMAND or LISTEN. */
    public final ProxyRole role;
    public final boolean isDirect;
    /** This device's key of the aircraft; null: the link is plain. */
    public final Pairing pairing;
    /** The certificates of TLS; null: plain TCP. */
    public final TlsIdentity tls;

    /**
     * Creates settings.
     *
     * @param host a name or address of the proxy or, {@code isDirect}, of the aircraft
     * @param port TCP, 1 to 65535
     * @param aircraft which of the proxy's aircraft, 1 to 32 of {@code A-Z a-z 0-9 _ . -}
     * @param seat COMMAND or LISTEN: the seat to request when the link opens
     * @param isDirect send no hello: an aircraft's listener in the same network
     * @throws IllegalArgumentException with one sentence that names the setting
     */
    public GroundSettings(String host, int port, String aircraft, ProxyRole seat,
            boolean isDirect) {
        this(host, port, aircraft, seat, isDirect, null, null);
    }

    private GroundSettings(String host, int port, String aircraft, ProxyRole seat,
            boolean isDirect, Pairing pairing, TlsIdentity tls) {
        SettingRules.host("host", host == null ? "" : host.trim());
        SettingRules.port("port", port);
        SettingRules.aircraft(aircraft);
        if (seat != ProxyRole.COMMAND && seat != ProxyRole.LISTEN) {
            throw new IllegalArgumentException("the seat must be to command or to listen");
        }
        this.host = host.trim();
        this.port = port;
        this.aircraft = aircraft;
        this.role = seat;
        this.isDirect = isDirect;
        this.pairing = pairing;
        this.tls = tls;
    }

    /** Returns these settings with a key of the aircraft: plain lines are refused; null: none. */
    public GroundSettings withPairing(Pairing key) {
        SettingRules.pairing(key, aircraft);
        return new GroundSettings(host, port, aircraft, role, isDirect, key, tls);
    }

    /** Returns these settings with TLS alone; null: plain TCP. */
    public GroundSettings withTls(TlsIdentity identity) {
        return new GroundSettings(host, port, aircraft, role, isDirect, pairing, identity);
    }

    /** Returns the key of this aircraft's token in a {@link TokenStore}. */
    public String tokenKey() {
        return host + "_" + port + "_" + aircraft;
    }
}
