package org.raspilot.up.security;

import java.util.regex.Matcher;
import java.util.regex.Pattern;
import org.raspilot.up.wire.Hello;

/** This device's key of one aircraft: the text that {@code up keys add} prints. Immutable. */
public final class Pairing {
    private static final Pattern TEXT = Pattern.compile("upkey:1:([^:]+):([0-9a-f]{16})"
            + ":([0-9a-f]{64}):(observer|operator|pilot|admin):([^:]+)");

    public final String aircraft;
    /** The role of the key at the time of the pairing. */
    public final String role;
    public final String name;
    private final String text;
    private final byte[] keyId;
    private final byte[] secret;

    private Pairing(Matcher found) {
        text = found.group();
        aircraft = found.group(1);
        keyId = bytes(found.group(2));
        secret = bytes(found.group(3));
        role = found.group(4);
        name = found.group(5);
    }

    /** Parses a text, with blanks around it; null: it is not a pairing text. */
    public static Pairing parse(String text) {
        final Matcher found = TEXT.matcher(text.trim());
        return found.matches() && Hello.isAircraftName(found.group(1))
                && Hello.isAircraftName(found.group(5)) ? new Pairing(found) : null;
    }

    /** Returns the pairing text, which contains the secret. */
    public String toText() {
        return text;
    }

    @Override
    public String toString() {
        return name + " (" + role + ")";
    }

    byte[] keyId() {
        return keyId.clone();
    }

    byte[] secret() {
        return secret.clone();
    }

    static String digits(byte[] bytes) {
        final StringBuilder digits = new StringBuilder();
        for (byte each : bytes) {
            digits.append(Character.forDigit(each >> 4 & 15, 16))
                    .append(Character.forDigit(each & 15, 16));
        }
        return digits.toString();
    }

    static byte[] bytes(String hexadecimal) {
        final byte[] bytes = new byte[hexadecimal.length() / 2];
        for (int at = 0; at < bytes.length; at++) {
            bytes[at] = (byte) Integer.parseInt(
                    hexadecimal.substring(2 * at, 2 * at + 2), 16);
        }
        return bytes;
    }
}
