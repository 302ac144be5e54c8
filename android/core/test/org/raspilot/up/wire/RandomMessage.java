package org.raspilot.up.wire;

import java.util.Arrays;
import java.util.Random;

/** Random messages, and lines damaged in transit. */
final class RandomMessage {
    private static final String[] PIECES = {
        "{", "}", "[", "]", "\"", ",", ":", "\\", "\\u", "d83d", "NaN", "-Infinity", "1e999", "-",
        "0", ".5", "e9", "null", "\"id\": 1, ", "\"name\": \"a\", ", "\r", "\n", "\u0000", "\u20ac",
    };

    private RandomMessage() {
    }

    /** Returns a message of at most 16 KiB. */
    static GeneralMessage of(Random random) {
        String id = random.nextBoolean() ? null : "i" + RandomJson.text(random, 20);
        Long beacon = random.nextBoolean() ? null : (Long) random.nextLong();
        return new GeneralMessage("n" + RandomJson.text(random, 20), RandomJson.fields(random, 4),
                id, beacon);
    }

    /** Returns a line with some of its bytes changed, removed, doubled or joined by others. */
    static byte[] damaged(Random random) {
        byte[] line = of(random).toLine();
        for (int i = random.nextInt(3); i >= 0; i--) {
            int from = random.nextInt(line.length + 1);
            int to = Math.min(line.length, from + random.nextInt(4));
            byte[] middle;
            switch (random.nextInt(4)) {
                case 0:
                    middle = new byte[0];
                    break;
                case 1:
                    middle = new byte[] {(byte) random.nextInt(256)};
                    break;
                case 2:
                    middle = Vectors.bytes(PIECES[random.nextInt(PIECES.length)]);
                    break;
                default:
                    middle = Arrays.copyOfRange(line, 0, from);
            }
            line = joined(Arrays.copyOf(line, from), middle,
                    Arrays.copyOfRange(line, to, line.length));
        }
        return line;
    }

    private static byte[] joined(byte[]... parts) {
        int length = 0;
        for (byte[] part : parts) {
            length += part.length;
        }
        byte[] all = new byte[length];
        int at = 0;
        for (byte[] part : parts) {
            System.arraycopy(part, 0, all, at, part.length);
            at += part.length;
        }
        return all;
    }
}
