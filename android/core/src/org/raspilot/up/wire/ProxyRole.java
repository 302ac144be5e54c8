package org.raspilot.up.wire;

import java.util.Locale;

/** What a connection to the proxy is for (docs/protocols.md 9). */
public enum ProxyRole {
    /** The ground that commands. */
    COMMAND,
    /** A ground that only listens. */
    LISTEN,
    /** The aircraft itself; sent only by the proxy, never requested. */
    AIR;

    public String word() {
        return name().toLowerCase(Locale.ROOT);
    }

    /** Returns the seat with that name, or null if unknown. */
    public static ProxyRole ofWord(String word) {
        for (ProxyRole seat : values()) {
            if (seat.word().equals(word)) {
                return seat;
            }
        }
        return null;
    }
}
