package org.raspilot.up.wire;

/**
 * The first line to a proxy: which aircraft, which seat, and the token that resumes it.
 *
 * <p>Source: docs/protocols.md 9.
 */
public final class Hello {
    /** Bytes of the longest hello with its LF. */
    public static final int LONGEST_LINE = 512;

    private final String aircraft;
    private final Seat seat;
    private final String token;

    private Hello(String aircraft, Seat seat, String token) {
        this.aircraft = aircraft;
        this.seat = seat;
        this.token = token;
    }

    /**
     * Makes an aircraft's hello; {@code token} null: none yet.
     *
     * @throws IllegalArgumentException when the name or the token has not the form of one
     */
    public static Hello ofAircraft(String aircraft, String token) {
        return new Hello(aircraft, null, token);
    }

    /**
     * Makes a ground's hello; {@code seat} is COMMAND or LISTEN, {@code token} null: none yet.
     *
     * @throws IllegalArgumentException when one of them has not the form of one
     */
    public static Hello ofGround(String aircraft, Seat seat, String token) {
        return new Hello(aircraft, seat, token);
    }

    /** Returns the name of the aircraft, 1 to 32 of {@code A-Z a-z 0-9 _ . -}. */
    public String aircraft() {
        return aircraft;
    }

    /** Returns the seat that is asked for; null: none is named. */
    public Seat seat() {
        return seat;
    }

    /** Returns the resume token, or null. */
    public String token() {
        return token;
    }

    /** Says whether a text can be the name of an aircraft. */
    public static boolean isAircraftName(String text) {
        return text != null && text.matches("[A-Za-z0-9_.-]{1,32}");
    }

    /** Says whether a text has the form of a resume token. */
    public static boolean isToken(String text) {
        return text != null && text.matches("[0-9a-f]{32,64}");
    }

    /**
     * Reads the hello of an aircraft ({@code isGround} false) or of a ground, without line end.
     *
     * @throws MalformedException when it is none
     */
    public static Hello read(String line, boolean isGround) throws MalformedException {
        throw new MalformedException("no hello");
    }

    /** Returns the line with its LF. */
    public byte[] toLine() {
        return new byte[0];
    }
}
