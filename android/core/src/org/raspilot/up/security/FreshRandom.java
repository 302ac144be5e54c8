package org.raspilot.up.security;

import java.io.DataInputStream;
import java.io.FileInputStream;
import java.io.IOException;
import java.security.SecureRandom;

/** The source of nonces. */
final class FreshRandom {
    private static final int SEED_BYTES = 32;

    private FreshRandom() {
    }

    /** Returns a source whose bytes no other start of the program repeats. */
    static SecureRandom create() {
        final SecureRandom random = new SecureRandom();
        try {
            random.setSeed(ofKernel());
        } catch (IOException absent) {
            // Not Linux: the system's own seed must do.
            return random;
        }
        return random;
    }

    /** The generator of Android 4.3 and earlier may repeat itself without this. */
    private static byte[] ofKernel() throws IOException {
        final byte[] seed = new byte[SEED_BYTES];
        final DataInputStream kernel = new DataInputStream(new FileInputStream("/dev/urandom"));
        try {
            kernel.readFully(seed);
        } finally {
            kernel.close();
        }
        return seed;
    }
}
