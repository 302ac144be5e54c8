package org.raspilot.up.commands;

import java.util.Locale;
import java.util.regex.Pattern;
import org.raspilot.up.wire.Json;
import org.raspilot.up.wire.MalformedException;

/** What a person typed into a field, as a JSON value. */
final class TypedValue {
    /** The result for text that is not a value of the type. */
    static final Object NONE = new Object();

    /**
     * The number keyboards of some phones have only a comma. Text that may be grouped thousands,
     * such as 1,000, is rejected: one metre is not a thousand.
     */
    private static final Pattern NUMBER = Pattern.compile(
            "[+-]?([0-9]+(\\.[0-9]+|,[0-9]{1,2}|,[0-9]{4,})?|0,[0-9]{3})");

    private TypedValue() {
    }

    /** Returns the value of a trimmed text, or NONE; {@code null} is null, whatever the type. */
    static Object of(String input, FieldType type) {
        if (input.equals("null")) {
            return null;
        }
        switch (type) {
            case BOOLEAN:
                return flag(input.toLowerCase(Locale.ROOT));
            case INTEGER:
            case NUMBER:
                return NUMBER.matcher(input).matches() ? number(input.replace(',', '.')) : NONE;
            case OBJECT:
            case LIST:
                return json(input);
            default:
                return input;
        }
    }

    private static Object flag(String input) {
        if (input.equals("true") || input.equals("yes")) {
            return Boolean.TRUE;
        }
        return input.equals("false") || input.equals("no") ? (Object) Boolean.FALSE : NONE;
    }

    private static Object number(String input) {
        String plain = input.startsWith("+") ? input.substring(1) : input;
        try {
            if (plain.indexOf('.') < 0) {
                return Long.valueOf(plain);
            }
            double number = Double.parseDouble(plain);
            return Double.isInfinite(number) ? NONE : (Object) number;
        } catch (NumberFormatException tooLong) {
            return NONE;
        }
    }

    private static Object json(String input) {
        try {
            return Json.parse(input);
        } catch (MalformedException noJson) {
            return NONE;
        }
    }
}
