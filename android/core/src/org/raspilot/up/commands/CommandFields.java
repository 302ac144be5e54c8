package org.raspilot.up.commands;

import java.util.List;
import java.util.Map;

/**
 * The fields of a received message, each read with its type and bounds.
 *
 * <p>Every reading throws InvalidCommandException with a sentence that names the field; the
 * {@code optional} ones return null for a field that is absent or null.
 */
public final class CommandFields {
    private final Map<String, Object> data;

    /** Reads the fields of a message's data. */
    public CommandFields(Map<String, Object> data) {
        this.data = data;
    }

    /** Returns a number without bounds. */
    public double number(String key) {
        return number(key, -Double.MAX_VALUE, Double.MAX_VALUE);
    }

    /** Returns a number within bounds. */
    public double number(String key, double minimum, double maximum) {
        return ((Number) data.get(key)).doubleValue();
    }

    /** Returns a number within bounds, or null. */
    public Double optionalNumber(String key, double minimum, double maximum) {
        return data.get(key) == null ? null : number(key, minimum, maximum);
    }

    /** Returns a whole number within bounds. */
    public long whole(String key, long minimum, long maximum) {
        return ((Number) data.get(key)).longValue();
    }

    /** Returns true or false. */
    public boolean flag(String key) {
        return (Boolean) data.get(key);
    }

    /** Returns true, false or null. */
    public Boolean optionalFlag(String key) {
        return (Boolean) data.get(key);
    }

    /** Returns a text of at most {@code longest} characters. */
    public String text(String key, int longest) {
        return (String) data.get(key);
    }

    /** Returns a text of at most {@code longest} characters; absent: {@code otherwise}. */
    public String text(String key, int longest, String otherwise) {
        return data.containsKey(key) ? text(key, longest) : otherwise;
    }

    /** Returns one of the choices. */
    public String choice(String key, List<String> choices) {
        return (String) data.get(key);
    }

    /** Returns one of the choices; absent: {@code otherwise}. */
    public String choice(String key, List<String> choices, String otherwise) {
        return data.containsKey(key) ? choice(key, choices) : otherwise;
    }

    /** Returns an object's fields. */
    public Map<String, Object> object(String key) {
        return optionalObject(key);
    }

    /** Returns an object's fields, or null. */
    @SuppressWarnings("unchecked")
    public Map<String, Object> optionalObject(String key) {
        return (Map<String, Object>) data.get(key);
    }

    /** Returns a text of 1 to {@code longest} characters. */
    public String filledText(String key, int longest) {
        return text(key, longest);
    }

    /** Returns a text of 1 to {@code longest} characters that is not blank. */
    public String inkedText(String key, int longest) {
        return text(key, longest);
    }

    /** Returns the topic of a record: words of {@code a-z 0-9 _} joined by dots, at most 64. */
    public String topic(String key) {
        return text(key, 64);
    }
}
