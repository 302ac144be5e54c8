package org.raspilot.up.wire;

/** Reads one string of a JSON text: the characters between two double quotes. */
final class JsonTextReader {
    private static final String ESCAPED = "\"\\/bfnrt";
    private static final String MEANT = "\"\\/\b\f\n\r\t";

    private final String source;
    private int at;
    private boolean hasSurrogateEscape;

    JsonTextReader(String source, int start) {
        this.source = source;
        at = start;
    }

    String read() throws MalformedException {
        int plain = at;
        StringBuilder pieces = null;
        while (true) {
            if (at >= source.length()) {
                throw notJson("a text has no end");
            }
            char c = source.charAt(at);
            if (c == '"') {
                String last = source.substring(plain, at);
                at++;
                return pieces == null ? last : pieces.append(last).toString();
            }
            if (c < ' ') {
                throw notJson("a control character in a text");
            }
            if (c == '\\') {
                if (pieces == null) {
                    pieces = new StringBuilder();
                }
                pieces.append(source, plain, at);
                at++;
                pieces.append(readEscape());
                plain = at;
            } else {
                at++;
            }
        }
    }

    /** Returns the end of the text, after its closing quote. */
    int end() {
        return at;
    }

    /** Returns whether a surrogate was escaped; unescaped ones are invalid UTF-8. */
    boolean hasSurrogateEscape() {
        return hasSurrogateEscape;
    }

    private char readEscape() throws MalformedException {
        char c = at < source.length() ? source.charAt(at) : 0;
        at++;
        if (c != 'u') {
            int index = ESCAPED.indexOf(c);
            if (index < 0) {
                throw notJson("an escape that JSON does not have");
            }
            return MEANT.charAt(index);
        }
        int code = 0;
        for (int i = 0; i < 4; i++) {
            int digit = at < source.length() ? hexDigit(source.charAt(at)) : -1;
            if (digit < 0) {
                throw notJson("an escape without its four digits");
            }
            code = code << 4 | digit;
            at++;
        }
        hasSurrogateEscape |= Json.isSurrogate((char) code);
        return (char) code;
    }

    /** Returns the value of an ASCII digit; Character.digit would take those of all scripts. */
    private static int hexDigit(char c) {
        return c < 0x80 ? Character.digit(c, 16) : -1;
    }

    private MalformedException notJson(String what) {
        return new MalformedException("not JSON: " + what + " at character " + at);
    }
}
