package org.raspilot.up.wire;

import java.util.regex.Pattern;

/** The words of a line of the proxy, {@code UP1} being word 0 (docs/protocols.md 9). */
final class ProxyLine {
    private static final Pattern NUMBER = Pattern.compile("[0-9]{1,9}");

    private final String[] words;

    ProxyLine(String line) {
        words = line.split(" ", -1);
    }

    /** Returns a word; an empty text if absent or if the line is not the proxy's. */
    String word(int index) {
        return words[0].equals("UP1") && index < words.length ? words[index] : "";
    }

    /** Returns the value of the last {@code key=value} of that key, or null. */
    String value(String key) {
        for (int i = words.length - 1; i > 0; i--) {
            if (words[i].startsWith(key + "=")) {
                return words[i].substring(key.length() + 1);
            }
        }
        return null;
    }

    /** Returns the number that a key has, or null. */
    Integer number(String key) {
        String value = value(key);
        return value != null && NUMBER.matcher(value).matches() ? Integer.valueOf(value) : null;
    }
}
