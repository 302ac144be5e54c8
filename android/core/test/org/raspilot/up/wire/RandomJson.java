package org.raspilot.up.wire;

import java.math.BigInteger;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;

/** Values that JSON can hold, by chance. */
final class RandomJson {
    private static final String CHARACTERS = "aZ09 _.\"\\/\n\t\u0000\u007f\u010d\u20ac{}[]:,";

    private RandomJson() {
    }

    /** Returns a value that is nested at most so deep. */
    static Object value(Random random, int depth) {
        switch (random.nextInt(depth > 0 ? 9 : 7)) {
            case 0:
                return null;
            case 1:
                return random.nextBoolean();
            case 2:
                return random.nextLong() >> random.nextInt(64);
            case 3:
                return BigInteger.ONE.shiftLeft(63).add(BigInteger.valueOf(random.nextInt(1000)));
            case 4:
                return random.nextGaussian() * Math.pow(10, random.nextInt(40) - 20);
            case 5:
            case 6:
                return text(random, 12);
            case 7:
                return fields(random, depth);
            default:
                List<Object> items = new ArrayList<>();
                for (int i = random.nextInt(4); i > 0; i--) {
                    items.add(value(random, depth - 1));
                }
                return items;
        }
    }

    /** Returns an object that is nested at most so deep. */
    static Map<String, Object> fields(Random random, int depth) {
        Map<String, Object> fields = new LinkedHashMap<>();
        for (int i = random.nextInt(4); i > 0; i--) {
            fields.put(text(random, 5), value(random, depth - 1));
        }
        return fields;
    }

    /** Returns a text of at most that many characters. */
    static String text(Random random, int longest) {
        StringBuilder text = new StringBuilder();
        for (int i = random.nextInt(longest + 1); i > 0; i--) {
            if (random.nextInt(10) == 0) {
                text.appendCodePoint(0x1f600 + random.nextInt(50));
            } else {
                text.append(CHARACTERS.charAt(random.nextInt(CHARACTERS.length())));
            }
        }
        return text.toString();
    }
}
