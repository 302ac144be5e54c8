package org.raspilot.up.wire;

import java.math.BigInteger;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/**
 * Reads one JSON text, by the rules of the protocol or, to find the id of a message that breaks
 * one of them, without these rules.
 */
final class JsonReader {
    /** Deep enough for any id that was meant, and shallow enough for the stack. */
    private static final int MAX_LENIENT_NESTING = 512;
    private static final int MAX_SHOWN_LENGTH = 40;
    private static final int MAX_INTEGER_LENGTH = 20;
    private static final int SURELY_LONG = 18;
    private static final String ESCAPED = "\"\\/bfnrt";
    private static final String MEANT = "\"\\/\b\f\n\r\t";

    private final String text;
    private final boolean isStrict;
    private int at;
    private int depth;

    JsonReader(String text, boolean isStrict) {
        this.text = text;
        this.isStrict = isStrict;
    }

    Object read() throws MalformedException {
        skipSpace();
        Object value = readValue();
        skipSpace();
        if (at < text.length()) {
            throw notJson("something follows the value");
        }
        return value;
    }

    private Object readValue() throws MalformedException {
        switch (peek()) {
            case '{':
                return readObject();
            case '[':
                return readList();
            case '"':
                return readText();
            case 't':
                return readWord("true", Boolean.TRUE);
            case 'f':
                return readWord("false", Boolean.FALSE);
            case 'n':
                return readWord("null", null);
            case 'N':
                return readConstant("NaN", Double.NaN);
            case 'I':
                return readConstant("Infinity", Double.POSITIVE_INFINITY);
            default:
                return readNumber();
        }
    }

    private Map<String, Object> readObject() throws MalformedException {
        enter();
        Map<String, Object> fields = new LinkedHashMap<>();
        boolean isIdRepeated = false;
        skipSpace();
        if (peek() == '}') {
            leave();
            return fields;
        }
        while (true) {
            if (peek() != '"') {
                throw notJson("a key in double quotes is missing");
            }
            if (isStrict && fields.size() == Json.MAX_KEYS) {
                throw new MalformedException("too_many_keys",
                        "an object with more than " + Json.MAX_KEYS + " keys");
            }
            String key = readText();
            skipSpace();
            expect(':', "a colon is missing");
            skipSpace();
            Object value = readValue();
            if (fields.containsKey(key)) {
                if (isStrict) {
                    throw new MalformedException("repeated_key",
                            "the key " + shown(key) + " is repeated");
                }
                isIdRepeated |= key.equals("id");
            }
            fields.put(key, value);
            skipSpace();
            if (peek() == '}') {
                break;
            }
            expect(',', "a comma is missing");
            skipSpace();
        }
        leave();
        if (isIdRepeated) {
            // It is ambiguous which one was meant.
            fields.remove("id");
        }
        return fields;
    }

    private List<Object> readList() throws MalformedException {
        enter();
        List<Object> items = new ArrayList<>();
        skipSpace();
        if (peek() == ']') {
            leave();
            return items;
        }
        while (true) {
            items.add(readValue());
            skipSpace();
            if (peek() == ']') {
                break;
            }
            expect(',', "a comma is missing");
            skipSpace();
        }
        leave();
        return items;
    }

    private String readText() throws MalformedException {
        int plain = ++at;
        boolean hasSurrogateEscape = false;
        StringBuilder pieces = null;
        for (char c = next(); c != '"'; c = next()) {
            if (c < ' ') {
                throw notJson("a control character in a text");
            }
            if (c == '\\') {
                pieces = pieces == null ? new StringBuilder() : pieces;
                pieces.append(text, plain, at - 1);
                char escaped = readEscape();
                hasSurrogateEscape |= Json.isSurrogate(escaped);
                pieces.append(escaped);
                plain = at;
            }
        }
        String last = text.substring(plain, at - 1);
        String read = pieces == null ? last : pieces.append(last).toString();
        // Unescaped lone surrogates are invalid UTF-8 already.
        if (isStrict && hasSurrogateEscape && Json.loneSurrogate(read) >= 0) {
            throw new MalformedException("lone_surrogate", "text with a lone surrogate");
        }
        return read;
    }

    private char next() throws MalformedException {
        if (at >= text.length()) {
            throw notJson("a text has no end");
        }
        return text.charAt(at++);
    }

    private char readEscape() throws MalformedException {
        char c = next();
        if (c != 'u') {
            int index = ESCAPED.indexOf(c);
            if (index < 0) {
                throw notJson("an escape that JSON does not have");
            }
            return MEANT.charAt(index);
        }
        int code = 0;
        for (int i = 0; i < 4; i++) {
            char digit = next();
            // Character.digit would take the digits of all scripts.
            int value = digit < 0x80 ? Character.digit(digit, 16) : -1;
            if (value < 0) {
                throw notJson("an escape without its four digits");
            }
            code = code << 4 | value;
        }
        return (char) code;
    }

    private Object readWord(String word, Object value) throws MalformedException {
        if (!text.startsWith(word, at)) {
            throw notJson("a value is missing");
        }
        at += word.length();
        return value;
    }

    private Object readConstant(String word, double value) throws MalformedException {
        Object constant = readWord(word, value);
        if (isStrict) {
            throw new MalformedException("not_a_number", word + " is not a JSON number");
        }
        return constant;
    }

    private Object readNumber() throws MalformedException {
        if (text.startsWith("-Infinity", at)) {
            return readConstant("-Infinity", Double.NEGATIVE_INFINITY);
        }
        int start = at;
        skip('-');
        if (!skip('0') && skipDigits() == 0) {
            at = start;
            throw notJson("a value is missing");
        }
        boolean isWhole = !skipFraction() & !skipExponent();
        String number = text.substring(start, at);
        return isWhole ? whole(number) : real(number);
    }

    /** Returns a Long or a BigInteger; null when not strict and longer than an id. */
    private Object whole(String number) throws MalformedException {
        if (isStrict && number.length() > MAX_INTEGER_LENGTH) {
            throw new MalformedException("number_too_long",
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

    private Object real(String number) throws MalformedException {
        double real = Double.parseDouble(number);
        if (isStrict && Double.isInfinite(real)) {
            throw new MalformedException("number_too_large", "the number "
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
        boolean isThere = peek() == wanted;
        at += isThere ? 1 : 0;
        return isThere;
    }

    private void enter() throws MalformedException {
        at++;
        depth++;
        if (depth > (isStrict ? Json.MAX_NESTING : MAX_LENIENT_NESTING)) {
            throw new MalformedException("too_deep", "nested deeper than " + Json.MAX_NESTING);
        }
    }

    private void leave() {
        at++;
        depth--;
    }

    private void expect(char wanted, String complaint) throws MalformedException {
        if (!skip(wanted)) {
            throw notJson(complaint);
        }
    }

    /** Returns the next character, or 0 at the end, which starts no value. */
    private char peek() {
        return at < text.length() ? text.charAt(at) : 0;
    }

    private void skipSpace() {
        while (at < text.length() && " \t\n\r".indexOf(text.charAt(at)) >= 0) {
            at++;
        }
    }

    private MalformedException notJson(String what) {
        return new MalformedException("not_json", "not JSON: " + what + " at character " + at);
    }

    private static String shown(String key) {
        return "'" + SafeText.of(key, MAX_SHOWN_LENGTH) + "'";
    }
}
