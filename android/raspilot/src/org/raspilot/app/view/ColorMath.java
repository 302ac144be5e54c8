package org.raspilot.app.view;

/** Colours computed from colours; each is an int of 8 bits alpha, red, green, blue. */
final class ColorMath {
    private ColorMath() {
    }

    /** Returns the grey that is as bright as a colour, with its alpha. */
    static int grey(int colour) {
        int bright = Math.round(0.2126f * red(colour) + 0.7152f * green(colour)
                + 0.0722f * blue(colour));
        return (colour & 0xff000000) | bright << 16 | bright << 8 | bright;
    }

    /** Returns a colour between two: the share 0 is the first, 1 the second; opaque. */
    static int between(int from, int to, float share) {
        return 0xff000000 | part(red(from), red(to), share) << 16
                | part(green(from), green(to), share) << 8 | part(blue(from), blue(to), share);
    }

    private static int part(int from, int to, float share) {
        return Math.max(0, Math.min(255, Math.round(from + (to - from) * share)));
    }

    private static int red(int colour) {
        return colour >> 16 & 0xff;
    }

    private static int green(int colour) {
        return colour >> 8 & 0xff;
    }

    private static int blue(int colour) {
        return colour & 0xff;
    }
}
