package org.raspilot.up.wire;

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

    private final String text;
    private final boolean isStrict;
    private int at;
    private int depth;

    JsonReader(String text, boolean isStrict) {
        this.text = text;
        this.isStrict = isStrict;
    }

    /** Returns the value that the whole text is. */
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
                throw new MalformedException(
                        "an object with more than " + Json.MAX_KEYS + " keys");
            }
            String key = readText();
            skipSpace();
            expect(':', "a colon is missing");
            skipSpace();
            Object value = readValue();
            if (fields.containsKey(key)) {
                if (isStrict) {
                    throw new MalformedException("the key " + shown(key) + " is repeated");
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
        JsonTextReader reader = new JsonTextReader(text, at + 1);
        String read = reader.read();
        at = reader.end();
        if (isStrict && reader.hasSurrogateEscape() && Json.loneSurrogate(read) >= 0) {
            throw new MalformedException("text with a lone surrogate");
        }
        return read;
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
            throw new MalformedException(word + " is not a JSON number");
        }
        return constant;
    }

    private Object readNumber() throws MalformedException {
        if (text.startsWith("-Infinity", at)) {
            return readConstant("-Infinity", Double.NEGATIVE_INFINITY);
        }
        JsonNumberReader reader = new JsonNumberReader(text, at);
        Object number = reader.read(isStrict);
        at = reader.end();
        return number;
    }

    private void enter() throws MalformedException {
        at++;
        depth++;
        if (depth > (isStrict ? Json.MAX_NESTING : MAX_LENIENT_NESTING)) {
            throw new MalformedException("nested deeper than " + Json.MAX_NESTING);
        }
    }

    private void leave() {
        at++;
        depth--;
    }

    private void expect(char wanted, String complaint) throws MalformedException {
        if (peek() != wanted) {
            throw notJson(complaint);
        }
        at++;
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
        return new MalformedException("not JSON: " + what + " at character " + at);
    }

    private static String shown(String key) {
        return "'" + SafeText.of(key, MAX_SHOWN_LENGTH) + "'";
    }
}
