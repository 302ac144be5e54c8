package org.raspilot.up.ground;

import java.math.BigDecimal;

/** One gain that differs between two sets. Immutable. */
public final class GainChange {
    public final GainKey key;
    /** Its value before; null: not known. */
    public final Double before;
    public final double after;

    GainChange(GainKey key, Double before, double after) {
        this.key = key;
        this.before = before;
        this.after = after;
    }

    /** Returns {@code rate roll P 3 to 2.4}. */
    @Override
    public String toString() {
        final String from = before == null ? "" : number(before) + " to ";
        return key.words() + " " + from + number(after);
    }

    /** Returns a gain as the shortest text that is this number, without an exponent. */
    static String number(double value) {
        if (Double.isNaN(value) || Double.isInfinite(value)) {
            return String.valueOf(value);
        }
        // The board holds gains in single precision: 0.1f is not 0.10000000149.
        final boolean isSingle = (float) value == value;
        final String text = isSingle ? Float.toString((float) value) : Double.toString(value);
        final String plain = new BigDecimal(text).toPlainString();
        return plain.contains(".") ? plain.replaceFirst("\\.?0+$", "") : plain;
    }
}
