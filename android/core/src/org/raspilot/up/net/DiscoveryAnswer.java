package org.raspilot.up.net;

import java.nio.charset.Charset;

/** Reads what Discovery answers: the Raspberry Pi's IPv4 address as text (protocols 7). */
final class DiscoveryAnswer {
    private static final int MAX_BYTES = 64;

    private DiscoveryAnswer() {
    }

    /**
     * Returns the address in an answer; for an empty answer the sender's address; null if it is not
     * an answer.
     */
    static String read(byte[] bytes, int length, String source) {
        if (length > MAX_BYTES) {
            return null;
        }
        final String text = new String(bytes, 0, length, Charset.forName("US-ASCII")).trim();
        if (text.isEmpty()) {
            return source;
        }
        return text.matches("[0-9]{1,3}(\\.[0-9]{1,3}){3}") ? text : null;
    }

    /**
     * Returns whether the phone may connect to an address: it is the sender's own, and private,
     * link-local, of a provider's NAT (RFC 6598), or this computer's.
     */
    static boolean isUsable(String address, String source) {
        if (!address.equals(source)) {
            return false;
        }
        final String[] words = source.split("\\.");
        final int first = Integer.parseInt(words[0]);
        final int second = Integer.parseInt(words[1]);
        return first == 10 || first == 127
                || first == 172 && second >= 16 && second < 32
                || first == 192 && second == 168
                || first == 169 && second == 254
                || first == 100 && second >= 64 && second < 128;
    }
}
