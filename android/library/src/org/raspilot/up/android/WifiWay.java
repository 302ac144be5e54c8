package org.raspilot.up.android;

import java.util.regex.Pattern;

/**
 * Decides when the process's sockets are bound to a Wi-Fi. A system prefers its mobile network to
 * a Wi-Fi without internet, on which an aeroplane's own access point would never be reached; but
 * a socket that is bound to a Wi-Fi no longer reaches what is tethered by USB.
 *
 * <p>So they are bound only while the other end lies in that Wi-Fi's own network. Where it is not
 * known yet (Discovery, a name), the way changes each {@link #TURN_MS} until there is a link,
 * beginning with the unbound one. All on one thread.
 */
final class WifiWay {
    /** So long one way is tried, ms: enough to ask by Discovery and to connect. */
    static final long TURN_MS = 5000;

    private static final Pattern NUMBERS =
            Pattern.compile("[0-9]{1,3}(\\.[0-9]{1,3}){3}|[0-9A-Fa-f:.%]*:[0-9A-Fa-f:.%]*");

    /** The system's part. */
    interface Wifi {
        /**
         * Binds the sockets that are made from now on to the Wi-Fi in whose network an address
         * lies; null: to any. Returns whether there is one.
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

    /**
     * Begins unbound.
     *
     * @param isWanted false: it is never bound
     * @param host the other end as the settings name it; empty: found by Discovery
     */
    WifiWay(Wifi wifi, boolean isWanted, String host) {
        this.wifi = wifi;
        this.isWanted = isWanted;
        fixed = address(host);
    }

    /** Hears that a network came, went, or has other addresses. */
    void networksChanged() {
        isChanged = true;
    }

    /**
     * Looks at the link, a few times a second.
     *
     * @param place where the link goes; null: there is none
     * @return whether another way is open now, so that an attempt is due at once
     */
    boolean look(long nowMs, String place) {
        if (!isWanted) {
            return false;
        }
        if (!isBegun) {
            isBegun = true;
            turnMs = nowMs;
        }
        boolean isConnected = place != null;
        boolean isNews = isChanged || isConnected != wasConnected;
        isChanged = false;
        wasConnected = isConnected;
        if (isConnected) {
            turnMs = nowMs;
        }
        String known = isConnected ? address(place) : fixed;
        if (known != null) {
            return isNews && keepTo(known) && !isConnected;
        }
        if (isNews && isBound) {
            // Perhaps it is this one that went.
            return keepTo(null) && !isConnected;
        }
        if (isConnected || nowMs - turnMs < TURN_MS) {
            return false;
        }
        turnMs = nowMs;
        return isBound ? release() : keepTo(null);
    }

    /** Leaves the choice to the system, for good. */
    void end() {
        release();
    }

    /** Binds where that is possible; returns whether it is another way than before. */
    private boolean keepTo(String address) {
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

    /** Returns an address in numbers; null for a name, which lies nowhere before it is asked. */
    private static String address(String host) {
        return NUMBERS.matcher(host).matches() ? host : null;
    }
}
