package org.raspilot.up.wire;

import java.util.LinkedHashMap;
import java.util.Locale;
import java.util.Map;
import java.util.regex.Pattern;

/**
 * The first line to a proxy: which aircraft, which seat, and the token that resumes it.
 *
 * <p>Source: docs/protocols.md 9.
 */
public final class Hello {
    private static final Pattern NAME = Pattern.compile("[A-Za-z0-9_-][A-Za-z0-9_.-]{0,31}");
    private static final Pattern TOKEN = Pattern.compile("[0-9a-f]{32,64}");
    private static final Pattern KEY = Pattern.compile("[A-Za-z0-9_.-]+");

    /** Bytes of the longest hello with its LF. */
    public static final int MAX_LINE_BYTES = 512;

    /** The name of the aircraft, 1 to 32 of {@code A-Z a-z 0-9 _ . -}, no dot first. */
    public final String aircraft;
    /** The seat that a ground requests; null: an aircraft's hello. */
    public final ProxyRole role;
    /** The resume token, or null. */
    public final String token;

    private Hello(String aircraft, ProxyRole seat, String token) {
        if (!isAircraftName(aircraft)) {
            throw new IllegalArgumentException(
                    "the aircraft's name must be 1 to 32 letters, digits, _ . or -");
        }
        if (token != null && !isToken(token)) {
            throw new IllegalArgumentException(
                    "the token must be 32 to 64 hexadecimal digits in lower case");
        }
        this.aircraft = aircraft;
        this.role = seat;
        this.token = token;
    }

    /**
     * Creates an aircraft's hello; {@code token} null: none yet.
     *
     * @throws IllegalArgumentException when the name or the token is malformed
     */
    public static Hello ofAircraft(String aircraft, String token) {
        return new Hello(aircraft, null, token);
    }

    /**
     * Creates a ground's hello; {@code seat} is COMMAND or LISTEN, {@code token} null: none yet.
     *
     * @throws IllegalArgumentException when one of them is malformed
     */
    public static Hello ofGround(String aircraft, ProxyRole seat, String token) {
        if (seat != ProxyRole.COMMAND && seat != ProxyRole.LISTEN) {
            throw new IllegalArgumentException("a ground asks to command or to listen");
        }
        return new Hello(aircraft, seat, token);
    }

    /** Returns whether a text is a valid name of an aircraft, for a proxy and for a runner. */
    public static boolean isAircraftName(String text) {
        return text != null && NAME.matcher(text).matches();
    }

    /** Returns whether a text has the form of a resume token. */
    public static boolean isToken(String text) {
        return text != null && TOKEN.matcher(text).matches();
    }

    /**
     * Parses the hello of an aircraft ({@code isGround} false) or of a ground, with or without its
     * line end; a ground that names no seat requests to command, unknown words are ignored.
     *
     * @throws MalformedException when it is not a hello
     */
    public static Hello read(byte[] line, int length, boolean isGround) throws MalformedException {
        if (length > MAX_LINE_BYTES) {
            throw new MalformedException("a hello is at most " + MAX_LINE_BYTES + " bytes");
        }
        Map<String, String> words = words(withoutEnd(line, length));
        String aircraft = words.get("aircraft");
        if (!isAircraftName(aircraft)) {
            throw new MalformedException("aircraft= must be 1 to 32 letters, digits, _ . or -");
        }
        String token = words.get("token");
        if (token != null) {
            token = token.toLowerCase(Locale.ROOT);
            if (!isToken(token)) {
                throw new MalformedException("token= must be 32 to 64 hexadecimal digits");
            }
        }
        return new Hello(aircraft, role(words.get("seat"), isGround), token);
    }

    /** Returns the line with its LF. */
    public byte[] toLine() {
        return Utf8.encode("UP1 aircraft=" + aircraft
                + (role == null ? "" : " seat=" + role.word())
                + (token == null ? "" : " token=" + token) + "\n");
    }

    private static String withoutEnd(byte[] line, int length) throws MalformedException {
        int end = length;
        if (end > 0 && line[end - 1] == '\n') {
            end--;
        }
        String text = Utf8.printableAscii(line, end);
        if (text == null) {
            throw new MalformedException("a hello is printable ASCII");
        }
        return text;
    }

    private static Map<String, String> words(String text) throws MalformedException {
        String[] words = text.split(" ", -1);
        if (!words[0].equals("UP1")) {
            throw new MalformedException("the first line must begin with UP1");
        }
        Map<String, String> values = new LinkedHashMap<>();
        for (int i = 1; i < words.length; i++) {
            int equals = words[i].indexOf('=');
            if (equals < 0 || !KEY.matcher(words[i].substring(0, equals)).matches()) {
                throw new MalformedException(
                        "a hello is words key=value with one space between them");
            }
            String key = words[i].substring(0, equals);
            if (values.containsKey(key)) {
                throw new MalformedException(key + " is repeated");
            }
            values.put(key, words[i].substring(equals + 1));
        }
        return values;
    }

    private static ProxyRole role(String word, boolean isGround) throws MalformedException {
        if (!isGround) {
            if (word != null) {
                throw new MalformedException("the airborne side names no seat");
            }
            return null;
        }
        ProxyRole seat = word == null ? ProxyRole.COMMAND : ProxyRole.ofWord(word);
        if (seat != ProxyRole.COMMAND && seat != ProxyRole.LISTEN) {
            throw new MalformedException("seat= must be command or listen");
        }
        return seat;
    }
}
