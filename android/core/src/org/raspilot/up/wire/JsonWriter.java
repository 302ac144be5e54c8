package org.raspilot.up.wire;

import java.math.BigInteger;
import java.util.Collection;
import java.util.Map;

/** Writes one JSON text; tracks its position, to name the place of an invalid value. */
final class JsonWriter {
    private static final String ESCAPED = "\"\\\b\f\n\r\t";
    private static final String ESCAPES = "\"\\bfnrt";
    private static final char[] HEX = "0123456789abcdef".toCharArray();

    private final StringBuilder out = new StringBuilder();
    private final Object[] place = new Object[Json.MAX_NESTING];
    private int depth;

    String write(Object value) {
        append(value);
        return out.toString();
    }

    private void append(Object value) {
        if (value == null || value instanceof Boolean) {
            out.append(value);
        } else if (value instanceof String) {
            appendText((String) value);
        } else if (value instanceof Number) {
            appendNumber((Number) value);
        } else if (value instanceof Map) {
            appendObject((Map<?, ?>) value);
        } else if (value instanceof Collection) {
            appendList((Collection<?>) value);
        } else {
            throw fault("is a " + value.getClass().getSimpleName() + ", which JSON cannot hold");
        }
    }

    private void appendObject(Map<?, ?> fields) {
        enter();
        String separator = "{";
        for (Map.Entry<?, ?> field : fields.entrySet()) {
            if (!(field.getKey() instanceof String)) {
                throw fault("has a key that is not text");
            }
            place[depth - 1] = field.getKey();
            out.append(separator);
            appendText((String) field.getKey());
            out.append(": ");
            append(field.getValue());
            separator = ", ";
        }
        out.append(fields.isEmpty() ? "{}" : "}");
        depth--;
    }

    private void appendList(Collection<?> items) {
        enter();
        int index = 0;
        for (Object item : items) {
            place[depth - 1] = index;
            out.append(index == 0 ? "[" : ", ");
            append(item);
            index++;
        }
        out.append(index == 0 ? "[]" : "]");
        depth--;
    }

    private void appendNumber(Number number) {
        if (number instanceof Double || number instanceof Float) {
            double real = number.doubleValue();
            if (Double.isNaN(real) || Double.isInfinite(real)) {
                throw fault("is " + ShortestNumber.text(real));
            }
            out.append(ShortestNumber.text(real));
        } else if (number instanceof Long || number instanceof Integer || number instanceof Short
                || number instanceof Byte || number instanceof BigInteger) {
            out.append(number);
        } else {
            throw fault("is a " + number.getClass().getSimpleName() + ", which JSON cannot hold");
        }
    }

    private void appendText(String text) {
        if (Json.loneSurrogate(text) >= 0) {
            throw fault("is text with a lone surrogate");
        }
        out.append('"');
        for (int i = 0; i < text.length(); i++) {
            char c = text.charAt(i);
            int escape = ESCAPED.indexOf(c);
            if (escape >= 0) {
                out.append('\\').append(ESCAPES.charAt(escape));
            } else if (c >= ' ' && c <= '~') {
                out.append(c);
            } else {
                out.append("\\u").append(HEX[c >> 12]).append(HEX[c >> 8 & 15])
                        .append(HEX[c >> 4 & 15]).append(HEX[c & 15]);
            }
        }
        out.append('"');
    }

    private void enter() {
        if (depth == Json.MAX_NESTING) {
            throw fault("is nested deeper than " + Json.MAX_NESTING);
        }
        depth++;
        place[depth - 1] = null;
    }

    private IllegalArgumentException fault(String what) {
        StringBuilder path = new StringBuilder();
        for (int i = 0; i < depth; i++) {
            if (place[i] instanceof Integer) {
                path.append('[').append(place[i]).append(']');
            } else if (place[i] != null) {
                path.append(path.length() == 0 ? "" : ".").append(place[i]);
            }
        }
        return new IllegalArgumentException((path.length() == 0 ? "the value" : path) + " " + what);
    }
}
