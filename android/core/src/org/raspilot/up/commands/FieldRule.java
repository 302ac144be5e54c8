package org.raspilot.up.commands;

import java.math.BigInteger;
import java.util.Collection;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import org.raspilot.up.wire.SafeText;

/**
 * The rule for the value of a field: its type, bounds, choices and length.
 *
 * <p>A whole number is also a number; a number without a fraction is not a whole number. The
 * contents of objects and lists are not checked.
 */
final class FieldRule {
    private static final int MAX_SHOWN_LENGTH = 40;

    private final FieldType type;
    private final double minimum;
    private final double maximum;
    private final List<?> choices;
    private final int maxLength;
    private final String description;

    /**
     * Creates a rule; {@code choices} null: no restriction; {@code description}: after "must be".
     */
    FieldRule(FieldType type, double minimum, double maximum, List<?> choices, int maxLength,
            String description) {
        this.type = type;
        this.minimum = minimum;
        this.maximum = maximum;
        this.choices = choices;
        this.maxLength = maxLength;
        this.description = description;
    }

    static FieldRule of(FieldType type) {
        String noun = type == FieldType.BOOLEAN ? "true or false"
                : type == FieldType.LIST ? "a list" : "a map";
        return new FieldRule(type, 0, 0, null, Integer.MAX_VALUE, noun);
    }

    static FieldRule number(double minimum, double maximum) {
        return new FieldRule(FieldType.NUMBER, minimum, maximum, null, 0,
                "a number" + range(minimum, maximum));
    }

    static FieldRule whole(long minimum, long maximum) {
        return new FieldRule(FieldType.INTEGER, minimum, maximum, null, 0,
                "a whole number" + range(minimum, maximum));
    }

    static FieldRule text(int maxLength) {
        return new FieldRule(FieldType.TEXT, 0, 0, null, maxLength,
                "text of at most " + maxLength + " characters");
    }

    static FieldRule choice(List<String> choices) {
        StringBuilder description = new StringBuilder("one of ");
        for (String choice : choices) {
            description.append(description.length() > 7 ? ", " : "").append(shown(choice));
        }
        return new FieldRule(FieldType.TEXT, 0, 0, Collections.unmodifiableList(choices),
                Integer.MAX_VALUE, description.toString());
    }

    /** Throws InvalidCommandException unless a value is valid. */
    void check(String field, Object value) {
        String code = !isOfType(value) ? "wrong_type" : !isInRange(value) ? "out_of_range"
                : !isChosen(value) ? "unknown_choice" : length(value) > maxLength ? "too_long" : "";
        if (!code.isEmpty()) {
            throw refusal(code, field,
                    code.equals("too_long") ? "of " + length(value) : shown(value));
        }
    }

    InvalidCommandException refusal(String code, String field, String not) {
        return new InvalidCommandException(code, field,
                "must be " + description + ", not " + not);
    }

    private boolean isOfType(Object value) {
        switch (type) {
            case BOOLEAN:
                return value instanceof Boolean;
            case INTEGER:
                return value instanceof Long;
            case NUMBER:
                return value instanceof Number;
            case TEXT:
                return value instanceof String;
            case LIST:
                return value instanceof List;
            default:
                return value instanceof Map;
        }
    }

    private boolean isInRange(Object value) {
        if (!(value instanceof Number)) {
            return true;
        }
        double number = ((Number) value).doubleValue();
        // NaN compares as false.
        return minimum <= number && number <= maximum;
    }

    private boolean isChosen(Object value) {
        if (choices == null) {
            return true;
        }
        for (Object choice : choices) {
            if (choice.equals(value) || choice instanceof Number && value instanceof Number
                    && ((Number) choice).doubleValue() == ((Number) value).doubleValue()) {
                return true;
            }
        }
        return false;
    }

    private static int length(Object value) {
        if (value instanceof String) {
            return ((String) value).codePointCount(0, ((String) value).length());
        }
        if (value instanceof Map) {
            return ((Map<?, ?>) value).size();
        }
        return value instanceof Collection ? ((Collection<?>) value).size() : 0;
    }

    private static String range(double minimum, double maximum) {
        boolean hasMinimum = minimum > -Double.MAX_VALUE;
        if (maximum < Double.MAX_VALUE) {
            return hasMinimum ? " between " + bound(minimum) + " and " + bound(maximum)
                    : " of at most " + bound(maximum);
        }
        return hasMinimum ? " of at least " + bound(minimum) : "";
    }

    private static String bound(double bound) {
        return bound == Math.rint(bound) ? String.valueOf((long) bound) : String.valueOf(bound);
    }

    /** Returns any value as a short text for a sentence. */
    static String shown(Object value) {
        if (value instanceof String) {
            return '"' + SafeText.of((String) value, MAX_SHOWN_LENGTH) + '"';
        }
        if (value instanceof Map) {
            return "a map";
        }
        if (value instanceof Collection) {
            return "a list";
        }
        return value == null || value instanceof Boolean || value instanceof Double
                || value instanceof Long || value instanceof BigInteger ? String.valueOf(value)
                : "a " + value.getClass().getSimpleName();
    }
}
