package org.raspilot.up.wire;

import java.io.ByteArrayOutputStream;
import java.util.Arrays;

/**
 * Lines that are not JSON: a type byte and binary data, in which LF and ESC are two bytes, ESC and
 * the byte with bit 6 inverted. Source: docs/protocols.md 4.
 */
public final class BinaryLine {
    /**
     * The first byte of such a line: packed telemetry, a protected message, a handshake, a short
     * protected message.
     */
    public static final byte PACKED = 1;
    public static final byte PROTECTED = 2;
    public static final byte HANDSHAKE = 3;
    public static final byte SHORT = 4;

    private static final byte LF = '\n';
    private static final byte ESC = 0x1b;
    private static final int FLIP = 0x40;

    private BinaryLine() {
    }

    /** Returns whether a line or body with that first byte is binary. */
    public static boolean isType(byte first) {
        return first >= PACKED && first <= SHORT;
    }

    /** Returns the line of a binary body, with its LF. */
    public static byte[] toLine(byte[] body) {
        final ByteArrayOutputStream line = new ByteArrayOutputStream(body.length + 32);
        for (byte each : body) {
            if (each == LF || each == ESC) {
                line.write(ESC);
                line.write(each ^ FLIP);
            } else {
                line.write(each);
            }
        }
        line.write(LF);
        return line.toByteArray();
    }

    /**
     * Returns the body of the first {@code length} bytes of a line without its LF; JSON is a body.
     *
     * @throws MalformedException for a wrong escape
     */
    public static byte[] toBody(byte[] line, int length) throws MalformedException {
        if (length == 0 || !isType(line[0])) {
            return Arrays.copyOf(line, length);
        }
        final byte[] body = new byte[length];
        int size = 0;
        for (int at = 0; at < length; at++) {
            byte each = line[at];
            if (each == ESC) {
                at++;
                each = at < length ? (byte) (line[at] ^ FLIP) : 0;
                if (each != LF && each != ESC) {
                    throw new MalformedException("escape", "an escape of a binary line is wrong");
                }
            }
            body[size++] = each;
        }
        return Arrays.copyOf(body, size);
    }
}
