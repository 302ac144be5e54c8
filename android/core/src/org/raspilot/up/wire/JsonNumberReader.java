package org.raspilot.up.wire;

import java.math.BigInteger;

/** Reads one number of a JSON text. */
final class JsonNumberReader {
    private static final int MAX_INTEGER_LENGTH = 20;
    private static final int SURELY_LONG = 18;

    private final String text;
    private final int start;
    private int at;

    JsonNumberReader(String text, int start) {
        this.text = text;
        this.start = start;
        at = start;
    }

    int end() {
        return at;
    }

    /**
     * Returns a Long, a BigInteger or a Double; when not strict a Double may be infinite, and a
     * whole number longer than an id is null.
     */
    Object read(boolean isStrict) throws MalformedException {
        skip('-');
        if (!skip('0') && skipDigits() == 0) {
            throw new MalformedException("not JSON: a value is missing at character " + start);
        }
        boolean isWhole = !skipFraction() & !skipExponent();
        String number = text.substring(start, at);
        return isWhole ? whole(number, isStrict) : real(number, isStrict);
    }

    private static Object whole(String number, boolean isStrict) throws MalformedException {
        if (isStrict && number.length() > MAX_INTEGER_LENGTH) {
            throw new MalformedException(
                    "a whole number of more than " + MAX_INTEGER_LENGTH + " characters");
        }
        if (number.length() <= SURELY_LONG) {
            return Long.valueOf(number);
        }
        if (number.length() > GeneralMessage.MAX_ID_LENGTH) {
            return null;
        }
        BigInteger whole = new BigInteger(number);
        return whole.bitLength() < Long.SIZE ? (Object) whole.longValue() : whole;
    }

    private static Object real(String number, boolean isStrict) throws MalformedException {
        double real = Double.parseDouble(number);
        if (isStrict && Double.isInfinite(real)) {
            throw new MalformedException("the number "
                    + number.substring(0, Math.min(20, number.length())) + " is too large");
        }
        return real;
    }

    /** Takes a fraction; a point without digits is not consumed. */
    private boolean skipFraction() {
        int before = at;
        if (skip('.') && skipDigits() > 0) {
            return true;
        }
        at = before;
        return false;
    }

    private boolean skipExponent() {
        int before = at;
        if (skip('e') || skip('E')) {
            if (!skip('+')) {
                skip('-');
            }
            if (skipDigits() > 0) {
                return true;
            }
        }
        at = before;
        return false;
    }

    private int skipDigits() {
        int before = at;
        while (at < text.length() && text.charAt(at) >= '0' && text.charAt(at) <= '9') {
            at++;
        }
        return at - before;
    }

    private boolean skip(char wanted) {
        if (at < text.length() && text.charAt(at) == wanted) {
            at++;
            return true;
        }
        return false;
    }
}
