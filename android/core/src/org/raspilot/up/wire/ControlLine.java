package org.raspilot.up.wire;

/**
 * A line between proxy and ground that is not relayed: the owner of control, and whether the
 * aircraft is connected. Source: docs/protocols.md 9.
 */
public final class ControlLine {
    public enum Kind {
        /** Ground to proxy: requests the seat that commands. */
        SEAT_REQUEST,
        /** Proxy to holder: listener {@link #number} requests the seat. */
        SEAT_ASKED,
        /** Holder to proxy: hands the seat to listener {@link #number}. */
        SEAT_GIVE,
        /** Holder to proxy: leaves the seat free. */
        SEAT_RELEASE,
        /** Proxy to ground: you command now; {@link #token} resumes it. */
        SEAT_COMMAND,
        /** Proxy to ground: you listen now. */
        SEAT_LISTEN,
        /** Proxy to all: ground {@link #number} commands; null: none. */
        SEAT_HOLDER,
        /** Proxy to all: the airborne side came. */
        AIRCRAFT_ONLINE,
        /** Proxy to all: the airborne side went. */
        AIRCRAFT_OFFLINE
    }

    public final Kind kind;
    /** The number of a ground, or null. */
    public final Integer number;
    /** The token of SEAT_COMMAND, otherwise null. */
    public final String token;

    private ControlLine(Kind kind, Integer number, String token) {
        this.kind = kind;
        this.number = number;
        this.token = token;
    }

    /**
     * Creates a line that needs neither a number nor a token; for SEAT_HOLDER: none commands.
     *
     * @throws IllegalArgumentException for a kind that needs one
     */
    public static ControlLine of(Kind kind) {
        if (kind == Kind.SEAT_ASKED || kind == Kind.SEAT_GIVE || kind == Kind.SEAT_COMMAND) {
            throw new IllegalArgumentException(kind + " needs a number or a token");
        }
        return new ControlLine(kind, null, null);
    }

    /**
     * Makes SEAT_ASKED, SEAT_GIVE or SEAT_HOLDER with the number of a ground.
     *
     * @throws IllegalArgumentException for another kind and a negative number
     */
    public static ControlLine of(Kind kind, int number) {
        if (kind != Kind.SEAT_ASKED && kind != Kind.SEAT_GIVE && kind != Kind.SEAT_HOLDER
                || number < 0) {
            throw new IllegalArgumentException(kind + " has no number " + number);
        }
        return new ControlLine(kind, number, null);
    }

    /**
     * Creates SEAT_COMMAND with the token that resumes the seat.
     *
     * @throws IllegalArgumentException when the token is malformed
     */
    public static ControlLine seatCommand(String token) {
        if (!Hello.isToken(token)) {
            throw new IllegalArgumentException("a token is 32 to 64 hexadecimal digits");
        }
        return new ControlLine(Kind.SEAT_COMMAND, null, token);
    }

    /** Returns whether a line starts as those that are never relayed: not a General Message. */
    public static boolean isControlLine(byte[] line, int length) {
        return length >= 4 && line[0] == 'U' && line[1] == 'P' && line[2] == '1' && line[3] == ' ';
    }

    /** Parses a line without line end; null if unknown. Unknown words are ignored. */
    public static ControlLine read(byte[] line, int length) {
        String text = Utf8.printableAscii(line, length);
        if (text == null) {
            return null;
        }
        ProxyLine words = new ProxyLine(text);
        if (words.word(1).equals("aircraft")) {
            if (words.word(2).equals("online")) {
                return of(Kind.AIRCRAFT_ONLINE);
            }
            return words.word(2).equals("offline") ? of(Kind.AIRCRAFT_OFFLINE) : null;
        }
        return words.word(1).equals("seat") ? seatLine(words) : null;
    }

    private static ControlLine seatLine(ProxyLine words) {
        String verb = words.word(2);
        if (verb.equals("request")) {
            return of(Kind.SEAT_REQUEST);
        }
        if (verb.equals("release")) {
            return of(Kind.SEAT_RELEASE);
        }
        if (verb.equals("listen")) {
            return of(Kind.SEAT_LISTEN);
        }
        if (verb.equals("command")) {
            String token = words.value("token");
            return Hello.isToken(token) ? seatCommand(token) : null;
        }
        if (verb.equals("asked")) {
            return numbered(Kind.SEAT_ASKED, words.number("by"));
        }
        if (verb.equals("give")) {
            return numbered(Kind.SEAT_GIVE, words.number("to"));
        }
        if ("none".equals(words.value("holder"))) {
            return of(Kind.SEAT_HOLDER);
        }
        return numbered(Kind.SEAT_HOLDER, words.number("holder"));
    }

    private static ControlLine numbered(Kind kind, Integer number) {
        return number == null ? null : of(kind, number);
    }

    /** Returns the line with its LF. */
    public byte[] toLine() {
        return Utf8.encode("UP1 " + text() + "\n");
    }

    private String text() {
        switch (kind) {
            case SEAT_REQUEST:
                return "seat request";
            case SEAT_ASKED:
                return "seat asked by=" + number;
            case SEAT_GIVE:
                return "seat give to=" + number;
            case SEAT_RELEASE:
                return "seat release";
            case SEAT_COMMAND:
                return "seat command token=" + token;
            case SEAT_LISTEN:
                return "seat listen";
            case SEAT_HOLDER:
                return "seat holder=" + (number == null ? "none" : number.toString());
            case AIRCRAFT_ONLINE:
                return "aircraft online";
            default:
                return "aircraft offline";
        }
    }
}
