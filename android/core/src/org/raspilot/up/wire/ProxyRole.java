package org.raspilot.up.wire;

/** What a connection to the proxy is for (docs/protocols.md 9). */
public enum ProxyRole {
    /** The ground that commands. */
    COMMAND("command"),
    /** A ground that only listens. */
    LISTEN("listen"),
    /** The aircraft itself; sent only by the proxy, never requested. */
    AIR("air");

    private final String word;

    ProxyRole(String word) {
        this.word = word;
    }

    /** Returns the word on the wire. */
    public String word() {
        return word;
    }

    /** Returns the seat with that name, or null if unknown. */
    public static ProxyRole ofWord(String word) {
        for (ProxyRole seat : values()) {
            if (seat.word.equals(word)) {
                return seat;
            }
        }
        return null;
    }
}
