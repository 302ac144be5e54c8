package org.raspilot.up.wire;

/**
 * A line of the proxy that is not relayed: the owner of control, and whether the aircraft is
 * connected; and the requests of a ground. Source: docs/protocols.md 9.
 */
public final class ControlLine {
    public enum Kind {
        /** To the holder: listener {@link #number} requests the seat. */
        SEAT_ASKED,
        /** You command now; {@link #token} resumes it. */
        SEAT_COMMAND,
        SEAT_LISTEN,
        /** Ground {@link #number} commands; null: none. */
        SEAT_HOLDER,
        /** The airborne side came. */
        AIRCRAFT_ONLINE,
        /** The airborne side went. */
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

    public static byte[] seatRequest() {
        return Utf8.encode("UP1 seat request\n");
    }

    public static byte[] seatRelease() {
        return Utf8.encode("UP1 seat release\n");
    }

    /** Returns the line with which the holder hands the seat to the listener of a number. */
    public static byte[] seatGive(int number) {
        return Utf8.encode("UP1 seat give to=" + number + "\n");
    }

    public static byte[] keyRequest() {
        return Utf8.encode("UP1 key\n");
    }

    /** Returns whether a line starts as those that are never relayed: not a General Message. */
    public static boolean isControlLine(byte[] line, int length) {
        return length >= 4 && line[0] == 'U' && line[1] == 'P' && line[2] == '1' && line[3] == ' ';
    }

    /** Parses a proxy's line without line end; null if unknown. Unknown words are ignored. */
    public static ControlLine read(byte[] line, int length) {
        String text = Utf8.printableAscii(line, length);
        ProxyLine words = new ProxyLine(text == null ? "" : text);
        switch (words.word(1) + " " + words.word(2)) {
            case "aircraft online":
                return new ControlLine(Kind.AIRCRAFT_ONLINE, null, null);
            case "aircraft offline":
                return new ControlLine(Kind.AIRCRAFT_OFFLINE, null, null);
            case "seat listen":
                return new ControlLine(Kind.SEAT_LISTEN, null, null);
            case "seat command":
                String token = words.value("token");
                return Hello.isToken(token) ? new ControlLine(Kind.SEAT_COMMAND, null, token)
                        : null;
            case "seat asked":
                return numbered(Kind.SEAT_ASKED, words.number("by"));
            case "seat holder=none":
                return new ControlLine(Kind.SEAT_HOLDER, null, null);
            default:
                return words.word(1).equals("seat")
                        ? numbered(Kind.SEAT_HOLDER, words.number("holder")) : null;
        }
    }

    private static ControlLine numbered(Kind kind, Integer number) {
        return number == null ? null : new ControlLine(kind, number, null);
    }
}
