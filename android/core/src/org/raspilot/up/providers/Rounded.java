package org.raspilot.up.providers;

/** Rounds numbers to their useful precision, to keep messages short. */
final class Rounded {
    private Rounded() {}

    /** Returns the value with that number of decimals; a value that is not finite is unchanged. */
    static double to(int decimals, double value) {
        double scale = Math.pow(10, decimals);
        return Double.isNaN(value) || Double.isInfinite(value)
                ? value
                : Math.rint(value * scale) / scale;
    }

    /** Returns a direction within 0 to 360 with one decimal, 360 excluded. */
    static double direction(double deg) {
        return to(1, Attitude.circle(deg)) % 360;
    }
}
