package org.raspilot.up.commands;

import java.util.List;
import java.util.Map;
import java.util.regex.Pattern;

/**
 * The fields of a received message, each read with its type and bounds.
 *
 * <p>Every reading throws InvalidCommandException with a sentence that names the field; the
 * {@code optional} ones return null for a field that is absent or null.
 */
public final class CommandFields {
    private static final Pattern TOPIC = Pattern.compile("[a-z0-9_]+(\\.[a-z0-9_]+)+");

    private final Map<String, Object> data;

    public CommandFields(Map<String, Object> data) {
        this.data = data;
    }

    public double number(String key) {
        return number(key, -Double.MAX_VALUE, Double.MAX_VALUE);
    }

    public double number(String key, double minimum, double maximum) {
        return ((Number) checked(key, FieldRule.number(minimum, maximum))).doubleValue();
    }

    /** Returns a number within bounds, or null. */
    public Double optionalNumber(String key, double minimum, double maximum) {
        return data.get(key) == null ? null : (Double) number(key, minimum, maximum);
    }

    public long whole(String key, long minimum, long maximum) {
        return ((Number) checked(key, FieldRule.whole(minimum, maximum))).longValue();
    }

    /** Returns a whole number within bounds, or null. */
    public Long optionalWhole(String key, long minimum, long maximum) {
        return data.get(key) == null ? null : (Long) whole(key, minimum, maximum);
    }

    public boolean flag(String key) {
        return (Boolean) checked(key, FieldRule.of(FieldType.BOOLEAN));
    }

    /** Returns true, false or null. */
    public Boolean optionalFlag(String key) {
        return data.get(key) == null ? null : (Boolean) flag(key);
    }

    /** Returns a text of at most {@code longest} characters. */
    public String text(String key, int longest) {
        return (String) checked(key, FieldRule.text(longest));
    }

    /** Returns a text of at most {@code longest} characters; absent: {@code otherwise}. */
    public String text(String key, int longest, String otherwise) {
        return data.containsKey(key) ? text(key, longest) : otherwise;
    }

    public String choice(String key, List<String> choices) {
        return (String) checked(key, FieldRule.choice(choices));
    }

    /** Returns one of the choices; absent: {@code otherwise}. */
    public String choice(String key, List<String> choices, String otherwise) {
        return data.containsKey(key) ? choice(key, choices) : otherwise;
    }

    /** Returns one of the choices, or null. */
    public String optionalChoice(String key, List<String> choices) {
        return data.get(key) == null ? null : choice(key, choices);
    }

    @SuppressWarnings("unchecked")
    public Map<String, Object> object(String key) {
        return (Map<String, Object>) checked(key, FieldRule.of(FieldType.OBJECT));
    }

    /** Returns an object's fields, or null. */
    public Map<String, Object> optionalObject(String key) {
        return data.get(key) == null ? null : object(key);
    }

    /** Returns a text of 1 to {@code longest} characters. */
    public String filledText(String key, int longest) {
        String text = text(key, longest);
        if (text.isEmpty()) {
            throw new InvalidCommandException("empty", key,
                    "must have 1 to " + longest + " characters");
        }
        return text;
    }

    /** Returns a text of 1 to {@code longest} characters that is not blank. */
    public String inkedText(String key, int longest) {
        String text = filledText(key, longest);
        for (int i = 0; i < text.length(); i++) {
            char c = text.charAt(i);
            if (!Character.isWhitespace(c) && !Character.isSpaceChar(c) && c != '\u0085') {
                return text;
            }
        }
        throw new InvalidCommandException("empty", key, "must not be blank");
    }

    /** Returns the topic of a record: words of {@code a-z 0-9 _} joined by dots, at most 64. */
    public String topic(String key) {
        String topic = text(key, 64);
        if (!TOPIC.matcher(topic).matches()) {
            throw new InvalidCommandException("malformed", key,
                    "must be words of a to z, 0 to 9 and _, joined by dots: companion.airspeed");
        }
        return topic;
    }

    private Object checked(String key, FieldRule rule) {
        if (!data.containsKey(key)) {
            throw new InvalidCommandException("missing", key, "is missing");
        }
        rule.check(key, data.get(key));
        return data.get(key);
    }
}
