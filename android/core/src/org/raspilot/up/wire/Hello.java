package org.raspilot.up.wire;

import java.util.regex.Pattern;

/**
 * The first line of a ground to a proxy: which aircraft, which seat, the token that resumes it, and
 * that packed telemetry and attitude frames are read.
 *
 * <p>Source: docs/protocols.md 9.
 */
public final class Hello {
    private static final Pattern NAME = Pattern.compile("[A-Za-z0-9_-][A-Za-z0-9_.-]{0,31}");
    private static final Pattern TOKEN = Pattern.compile("[0-9a-f]{32,64}");

    private Hello() {
    }

    /** Returns the line with its LF; {@code token} null: none yet. */
    public static byte[] ofGround(String aircraft, ProxyRole seat, String token) {
        if (!isAircraftName(aircraft)) {
            throw new IllegalArgumentException(
                    "the aircraft's name must be 1 to 32 letters, digits, _ . or -");
        }
        if (seat != ProxyRole.COMMAND && seat != ProxyRole.LISTEN) {
            throw new IllegalArgumentException("a ground asks to command or to listen");
        }
        if (token != null && !isToken(token)) {
            throw new IllegalArgumentException(
                    "the token must be 32 to 64 hexadecimal digits in lower case");
        }
        return Utf8.encode("UP1 aircraft=" + aircraft + " seat=" + seat.word()
                + (token == null ? "" : " token=" + token) + " packed=1 attitude=1\n");
    }

    public static boolean isAircraftName(String text) {
        return text != null && NAME.matcher(text).matches();
    }

    public static boolean isToken(String text) {
        return text != null && TOKEN.matcher(text).matches();
    }
}
