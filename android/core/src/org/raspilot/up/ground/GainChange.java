package org.raspilot.up.ground;

import java.util.Locale;

/** One gain that differs between two sets. Immutable. */
public final class GainChange {
    private final GainKey key;
    private final Double before;
    private final double after;

    GainChange(GainKey key, Double before, double after) {
        this.key = key;
        this.before = before;
        this.after = after;
    }

    /** Returns which gain. */
    public GainKey key() {
        return key;
    }

    /** Returns its value before; null: not known. */
    public Double before() {
        return before;
    }

    /** Returns its value after. */
    public double after() {
        return after;
    }

    /** Returns {@code rate roll P 3 to 2.4}. */
    @Override
    public String toString() {
        final String from = before == null ? "" : number(before) + " to ";
        return key.words() + " " + from + number(after);
    }

    private static String number(double value) {
        final String text = String.format(Locale.ROOT, "%.4f", value);
        return text.replaceFirst("\\.?0+$", "");
    }
}
