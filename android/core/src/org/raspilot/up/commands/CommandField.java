package org.raspilot.up.commands;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

/** One field of a Command as the catalogue describes it. */
public final class CommandField {
    private final String name;
    private final FieldType type;
    private final String unit;
    private final Double minimum;
    private final Double maximum;
    private final List<Object> choices;
    private final Integer maxLength;
    private final boolean nullable;
    private final boolean required;
    private final String text;

    CommandField(String name, FieldType type, String unit, Double minimum, Double maximum,
            List<?> choices, Integer maxLength, boolean nullable, boolean required, String text) {
        this.name = name;
        this.type = type;
        this.unit = unit;
        this.minimum = minimum;
        this.maximum = maximum;
        this.choices = choices == null ? null
                : Collections.unmodifiableList(new ArrayList<Object>(choices));
        this.maxLength = maxLength;
        this.nullable = nullable;
        this.required = required;
        this.text = text;
    }

    /** Returns the name on the wire. */
    public String name() {
        return name;
    }

    /** Returns what kind of value it holds. */
    public FieldType type() {
        return type;
    }

    /** Returns the unit, or an empty text. */
    public String unit() {
        return unit;
    }

    /** Returns the least value, or null. */
    public Double minimum() {
        return minimum;
    }

    /** Returns the greatest value, or null. */
    public Double maximum() {
        return maximum;
    }

    /** Returns what may be chosen, unmodifiable, or null when anything may. */
    public List<Object> choices() {
        return choices;
    }

    /** Returns the greatest number of characters, items or keys, or null. */
    public Integer maxLength() {
        return maxLength;
    }

    /** Says whether null is allowed. */
    public boolean isNullable() {
        return nullable;
    }

    /** Says whether it may not be left out. */
    public boolean isRequired() {
        return required;
    }

    /** Returns what is allowed, in words: "a number between 0 and 5 s". */
    public String text() {
        return text;
    }

    /** Returns what is wrong with a JSON value, a sentence that names the field, or null. */
    public String validate(Object value) {
        return null;
    }

    /**
     * Returns the value that a person typed; the text is not empty.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public Object parse(String input) {
        return input;
    }
}
