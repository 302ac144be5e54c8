package org.raspilot.up.commands;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import org.raspilot.up.wire.MalformedException;

/** One field of a Command as the catalogue describes it. */
public final class CommandField {
    public final String name;
    public final FieldType type;
    /** The unit, or an empty text. */
    public final String unit;
    /** The least value, or null. */
    public final Double minimum;
    /** The greatest value, or null. */
    public final Double maximum;
    /** What may be chosen, unmodifiable, or null when anything may. */
    public final List<Object> choices;
    /** The greatest number of characters, items or keys, or null. */
    public final Integer maxLength;
    private final boolean nullable;
    private final boolean required;
    /** The allowed values in words: "a number between 0 and 5 s". */
    public final String text;
    private final FieldRule rule;

    CommandField(CatalogueEntry entry) throws MalformedException {
        name = entry.text("name");
        type = entry.type("type");
        unit = entry.text("unit");
        minimum = entry.optionalNumber("minimum");
        maximum = entry.optionalNumber("maximum");
        List<Object> listed = entry.optionalList("choices");
        choices = listed == null ? null
                : Collections.unmodifiableList(new ArrayList<>(listed));
        Double length = entry.optionalNumber("max_length");
        maxLength = length == null ? null : (Integer) length.intValue();
        nullable = entry.flag("nullable");
        required = entry.flag("required");
        text = entry.text("text");
        rule = new FieldRule(type, minimum == null ? -Double.MAX_VALUE : minimum,
                maximum == null ? Double.MAX_VALUE : maximum, choices,
                maxLength == null ? Integer.MAX_VALUE : maxLength, text);
    }

    public boolean isRequired() {
        return required;
    }

    /** Throws InvalidCommandException unless a JSON value is valid. */
    public void check(Object value) {
        if (value != null || !nullable) {
            rule.check(name, value);
        }
    }

    /**
     * Converts typed text to a JSON value; {@code null} gives null if the field allows null and is
     * not a text field.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public Object parse(String input) {
        Object value = type == FieldType.TEXT ? input : TypedValue.of(input.trim(), type);
        if (value == TypedValue.NONE) {
            throw rule.refusal("wrong_type", name, FieldRule.shown(input));
        }
        check(value);
        return value;
    }
}
