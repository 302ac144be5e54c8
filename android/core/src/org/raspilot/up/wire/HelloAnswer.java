package org.raspilot.up.wire;

import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * A proxy's answer to a hello: taken in with a seat and a token, or refused.
 *
 * <p>Source: docs/protocols.md 9.
 */
public final class HelloAnswer {
    private static final Pattern REFUSED =
            Pattern.compile("UP1 error code=([a-z]{1,32}) reason=\"([^\"]{0,400})\".*");

    /** The seat that was given, or null when refused. */
    public final ProxyRole role;
    /** The token that resumes the seat, or null when refused. */
    public final String token;
    /** {@code malformed taken full address token}, or null when accepted. */
    public final String code;
    /** Why it was refused, or null when accepted. */
    public final String reason;

    private HelloAnswer(ProxyRole seat, String token, String code, String reason) {
        this.role = seat;
        this.token = token;
        this.code = code;
        this.reason = reason;
    }

    public boolean isAccepted() {
        return code == null;
    }

    /**
     * Parses a line without line end; null if it is not an answer to a hello. Unknown words are
     * ignored.
     */
    public static HelloAnswer read(byte[] line, int length) {
        String text = Utf8.printableAscii(line, length);
        if (text == null) {
            return null;
        }
        Matcher refused = REFUSED.matcher(text);
        if (refused.matches()) {
            return new HelloAnswer(null, null, refused.group(1), refused.group(2));
        }
        ProxyLine words = new ProxyLine(text);
        ProxyRole seat = ProxyRole.ofWord(words.value("seat"));
        if (!words.word(1).equals("ok") || seat == null || !Hello.isToken(words.value("token"))) {
            return null;
        }
        return new HelloAnswer(seat, words.value("token"), null, null);
    }
}
