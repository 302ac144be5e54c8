package org.raspilot.up.wire;

/**
 * JSON as the wire has it: read strictly, written as Python's {@code json} writes it.
 *
 * <p>An object is a {@code LinkedHashMap<String, Object>}, a list an {@code ArrayList<Object>},
 * a text a String, a whole number a Long (a BigInteger beyond 64 bits, at most 20 characters), any
 * other number a Double, and further Boolean and null. Source: docs/protocols.md 4.
 */
public final class Json {
    /** Maximum nesting of objects and lists; the outermost counts as one. */
    public static final int MAX_NESTING = 32;
    /** Keys of one object; it bounds the work per message. */
    public static final int MAX_KEYS = 512;

    private Json() {
    }

    /**
     * Returns the one value that the text is.
     *
     * @throws MalformedException when it is not JSON, has NaN, infinity or a number beyond a
     *     double, a key twice or more than 512 keys in one object, a lone surrogate,
     *     or is nested deeper than 32
     */
    public static Object parse(String text) throws MalformedException {
        return new JsonReader(text, true).read();
    }

    /**
     * Returns a value as ASCII text with the separators {@code ", "} and {@code ": "}.
     *
     * @throws IllegalArgumentException, naming the place, for NaN, infinity, a lone surrogate,
     *     other values that JSON lacks, and nesting deeper than 32
     */
    public static String write(Object value) {
        return new JsonWriter().write(value);
    }

    /** Returns the index of the first surrogate that has no partner, or -1. */
    static int loneSurrogate(String text) {
        for (int i = 0; i < text.length(); i++) {
            char c = text.charAt(i);
            if (Character.isHighSurrogate(c) && i + 1 < text.length()
                    && Character.isLowSurrogate(text.charAt(i + 1))) {
                i++;
            } else if (isSurrogate(c)) {
                return i;
            }
        }
        return -1;
    }

    /** Returns whether it is a surrogate; Android 4.1 has no Character.isSurrogate. */
    static boolean isSurrogate(char c) {
        return c >= Character.MIN_SURROGATE && c <= Character.MAX_SURROGATE;
    }
}
