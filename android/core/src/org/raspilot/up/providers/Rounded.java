package org.raspilot.up.providers;

/** Numbers with as many decimals as they are worth: what is sent is short to write and to read. */
final class Rounded {
    private Rounded() {}

    /** Returns the value with so many decimals; what is not finite stays so. */
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
