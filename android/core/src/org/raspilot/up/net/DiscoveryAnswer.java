package org.raspilot.up.net;

import java.nio.charset.Charset;

/** Reads what Discovery answers: the Raspberry Pi's IPv4 address as text (protocols 7). */
final class DiscoveryAnswer {
    private static final int LONGEST = 64;

    private DiscoveryAnswer() {
    }

    /**
     * Returns the address in an answer; of an empty answer the address that it came from; null when
     * it is no answer: another text, or an address that no host can have.
     */
    static String read(byte[] bytes, int length, String source) {
        if (length > LONGEST) {
            return null;
        }
        final String text = new String(bytes, 0, length, Charset.forName("US-ASCII")).trim();
        if (text.isEmpty()) {
            return source;
        }
        if (!text.matches("[0-9]{1,3}(\\.[0-9]{1,3}){3}")) {
            return null;
        }
        final String[] words = text.split("\\.");
        final StringBuilder address = new StringBuilder();
        for (String word : words) {
            final int number = Integer.parseInt(word);
            if (number > 255 || word.length() > 1 && word.charAt(0) == '0') {
                // With a leading zero some systems read another number.
                return null;
            }
            address.append(address.length() == 0 ? "" : ".").append(number);
        }
        return isHost(Integer.parseInt(words[0]), source) ? address.toString() : null;
    }

    /** Neither nowhere, nor many, nor this phone itself unless it answered. */
    private static boolean isHost(int first, String source) {
        return first != 0 && first < 224 && (first != 127 || source.startsWith("127."));
    }
}
