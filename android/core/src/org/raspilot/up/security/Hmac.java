package org.raspilot.up.security;

import java.io.ByteArrayOutputStream;
import java.nio.ByteBuffer;
import java.nio.charset.Charset;
import java.security.GeneralSecurityException;
import java.security.MessageDigest;
import java.util.Arrays;
import javax.crypto.Mac;
import javax.crypto.spec.SecretKeySpec;

/** HMAC-SHA256, and HKDF-SHA256 of one block. Source: docs/security.md, "Construction". */
final class Hmac {
    static final int MAC_BYTES = 16;

    private static final String NAME = "HmacSHA256";
    private static final Charset ASCII = Charset.forName("US-ASCII");

    private Hmac() {
    }

    static byte[] extract(byte[] salt, byte[] secret) {
        return hmac(salt, secret);
    }

    /** Returns HKDF-Expand for a context: 32 bytes. */
    static byte[] expand(byte[] key, byte[]... context) {
        final byte[] parts = prefixed(context);
        final byte[] block = Arrays.copyOf(parts, parts.length + 1);
        block[parts.length] = 1;
        return hmac(key, block);
    }

    static byte[] mac(byte[] key, byte[]... parts) {
        return Arrays.copyOf(hmac(key, prefixed(parts)), MAC_BYTES);
    }

    /** Throws EnvelopeException, {@code forged}, unless the MACs agree; in constant time. */
    static void check(byte[] found, byte[] expected) throws EnvelopeException {
        if (!MessageDigest.isEqual(found, expected)) {
            throw new EnvelopeException("forged");
        }
    }

    static byte[] ascii(String text) {
        return text.getBytes(ASCII);
    }

    static byte[] number(int value) {
        return ByteBuffer.allocate(4).putInt(value).array();
    }

    private static byte[] prefixed(byte[]... parts) {
        final ByteArrayOutputStream all = new ByteArrayOutputStream();
        for (byte[] part : parts) {
            all.write(number(part.length), 0, 4);
            all.write(part, 0, part.length);
        }
        return all.toByteArray();
    }

    private static byte[] hmac(byte[] key, byte[] data) {
        try {
            final Mac mac = Mac.getInstance(NAME);
            mac.init(new SecretKeySpec(key, NAME));
            return mac.doFinal(data);
        } catch (GeneralSecurityException missing) {
            // Every Java and every Android has it.
            throw new IllegalStateException(missing);
        }
    }
}
