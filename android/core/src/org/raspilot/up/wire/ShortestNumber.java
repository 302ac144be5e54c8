package org.raspilot.up.wire;

import java.math.BigDecimal;
import java.math.MathContext;
import java.math.RoundingMode;

/**
 * A double in the fewest digits that read back as the same double, as Python writes it.
 *
 * <p>{@code Double.toString} is neither: it has digits too many for some numbers, and another form.
 */
final class ShortestNumber {
    private static final int MAX_DIGITS = 17;

    private ShortestNumber() {
    }

    /** Returns {@code 0.1}, {@code 5.0}, {@code 1e+16}, {@code -0.0}, {@code nan}, {@code inf}. */
    static String text(double number) {
        if (Double.isNaN(number)) {
            return "nan";
        }
        String sign = Double.doubleToRawLongBits(number) < 0 ? "-" : "";
        double magnitude = Math.abs(number);
        if (Double.isInfinite(magnitude)) {
            return sign + "inf";
        }
        return sign + (magnitude == 0 ? "0.0" : form(shortest(magnitude)));
    }

    private static BigDecimal shortest(double number) {
        BigDecimal exact = new BigDecimal(number);
        int digits = Math.min(MAX_DIGITS, digitsOf(number));
        BigDecimal best = nearest(exact, digits, number);
        while (best == null) {
            digits++;
            best = nearest(exact, digits, number);
        }
        while (digits > 1) {
            digits--;
            BigDecimal shorter = nearest(exact, digits, number);
            if (shorter == null) {
                break;
            }
            best = shorter;
        }
        return best.stripTrailingZeros();
    }

    /** Returns the number of digits of Double.toString: a good start for the search. */
    private static int digitsOf(double number) {
        int digits = 0;
        String text = Double.toString(number);
        for (int i = 0; i < text.length() && text.charAt(i) != 'E'; i++) {
            digits += text.charAt(i) == '.' ? 0 : 1;
        }
        return digits;
    }

    /** Returns the nearest decimal of that many digits that parses back to the number, or null. */
    private static BigDecimal nearest(BigDecimal exact, int digits, double number) {
        BigDecimal half = exact.round(new MathContext(digits, RoundingMode.HALF_EVEN));
        if (readsAs(half, number)) {
            return half;
        }
        // Below a power of two the doubles are twice as dense: the farther side may still do.
        BigDecimal up = exact.round(new MathContext(digits, RoundingMode.UP));
        return readsAs(up, number) ? up : null;
    }

    private static boolean readsAs(BigDecimal decimal, double number) {
        return Double.parseDouble(decimal.toString()) == number;
    }

    private static String form(BigDecimal decimal) {
        String digits = decimal.unscaledValue().toString();
        int point = digits.length() - decimal.scale();
        if (point > 16 || point < -3) {
            int exponent = point - 1;
            String fraction = digits.length() == 1 ? "" : "." + digits.substring(1);
            String padding = Math.abs(exponent) < 10 ? "0" : "";
            return digits.charAt(0) + fraction + "e" + (exponent < 0 ? "-" : "+") + padding
                    + Math.abs(exponent);
        }
        if (point <= 0) {
            return "0." + zeros(-point) + digits;
        }
        if (point >= digits.length()) {
            return digits + zeros(point - digits.length()) + ".0";
        }
        return digits.substring(0, point) + "." + digits.substring(point);
    }

    private static String zeros(int count) {
        return "0000000000000000".substring(0, count);
    }
}
