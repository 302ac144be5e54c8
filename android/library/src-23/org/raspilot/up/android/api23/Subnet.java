package org.raspilot.up.android.api23;

/** Whether two addresses of the internet lie in one network. */
public final class Subnet {
    private static final int BITS = 8;

    private Subnet() {
    }

    /** Returns whether both addresses lie in the same network of that prefix. */
    public static boolean holds(byte[] one, int prefixBits, byte[] other) {
        if (one.length != other.length || prefixBits <= 0 || prefixBits > one.length * BITS) {
            return false;
        }
        for (int bit = 0; bit < prefixBits; bit++) {
            int mask = 0x80 >> bit % BITS;
            if ((one[bit / BITS] & mask) != (other[bit / BITS] & mask)) {
                return false;
            }
        }
        return true;
    }
}
