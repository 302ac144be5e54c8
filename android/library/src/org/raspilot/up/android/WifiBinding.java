package org.raspilot.up.android;

import java.util.regex.Pattern;

/**
 * Decides when the process's sockets are bound to a Wi-Fi. A system prefers its mobile network to a
 * Wi-Fi without internet, and then never reaches an aeroplane's own access point; but a socket
 * bound to a Wi-Fi cannot reach a device tethered by USB.
 *
 * <p>So they are bound only while the peer lies in that Wi-Fi's own network. Where the peer's
 * address is unknown (Discovery, a name), the path alternates each {@link #TURN_MS} until there is
 * a link, starting unbound. All on one thread.
 */
final class WifiBinding {
    /** Duration of one attempt by one path, ms: enough for Discovery and connecting. */
    static final long TURN_MS = 5000;

    private static final Pattern NUMBERS =
            Pattern.compile("[0-9]{1,3}(\\.[0-9]{1,3}){3}|[0-9A-Fa-f:.%]*:[0-9A-Fa-f:.%]*");

    interface Wifi {
        /**
         * Binds future sockets to the Wi-Fi whose network contains an address; null: to any.
         * Returns whether there is one.
         */
        boolean bind(String address);

        /** Leaves the choice to the system again. */
        void release();
    }

    private final Wifi wifi;
    private final boolean isWanted;
    private final String fixed;
    private boolean isBound;
    private boolean isChanged = true;
    private boolean wasConnected;
    private boolean isBegun;
    private long turnMs;

    /** Starts unbound; {@code host} empty: the peer is found by Discovery. */
    WifiBinding(Wifi wifi, boolean isWanted, String host) {
        this.wifi = wifi;
        this.isWanted = isWanted;
        fixed = address(host);
    }

    /** Called when a network appeared, disappeared, or changed its addresses. */
    void networksChanged() {
        isChanged = true;
    }

    /**
     * Checks the link, a few times a second.
     *
     * @param place the peer of the link; null if unknown
     * @return whether the path has changed, so that a new attempt is due immediately
     */
    boolean check(long nowMs, String place) {
        if (!isWanted) {
            return false;
        }
        if (!isBegun) {
            isBegun = true;
            turnMs = nowMs;
        }
        boolean isConnected = place != null;
        boolean isNew = isChanged || isConnected != wasConnected;
        isChanged = false;
        wasConnected = isConnected;
        if (isConnected) {
            turnMs = nowMs;
        }
        String known = isConnected ? address(place) : fixed;
        if (known != null) {
            return isNew && bindTo(known) && !isConnected;
        }
        if (isNew && isBound) {
            // Perhaps it is this one that went.
            return bindTo(null) && !isConnected;
        }
        if (isConnected || nowMs - turnMs < TURN_MS) {
            return false;
        }
        turnMs = nowMs;
        return isBound ? release() : bindTo(null);
    }

    /** Leaves the choice to the system, for good. */
    void end() {
        release();
    }

    /** Binds if possible; returns whether the path has changed. */
    private boolean bindTo(String address) {
        if (!wifi.bind(address)) {
            return release();
        }
        boolean wasBound = isBound;
        isBound = true;
        return !wasBound;
    }

    private boolean release() {
        boolean wasBound = isBound;
        isBound = false;
        if (wasBound) {
            wifi.release();
        }
        return wasBound;
    }

    /** Returns a numeric address; null for a name, which is in no network before its look-up. */
    private static String address(String host) {
        return NUMBERS.matcher(host).matches() ? host : null;
    }
}
