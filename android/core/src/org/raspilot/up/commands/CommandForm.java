package org.raspilot.up.commands;

import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** A Command as a person fills it in: its name, what it is for, its fields. */
public final class CommandForm {
    private final String name;
    private final List<String> aliases;
    private final String role;
    private final String text;
    private final boolean needsBeacon;
    private final List<CommandField> fields;

    CommandForm(String name, List<String> aliases, String role, String text, boolean needsBeacon,
            List<CommandField> fields) {
        this.name = name;
        this.aliases = Collections.unmodifiableList(new ArrayList<String>(aliases));
        this.role = role;
        this.text = text;
        this.needsBeacon = needsBeacon;
        this.fields = Collections.unmodifiableList(new ArrayList<CommandField>(fields));
    }

    /** Returns the name on the wire. */
    public String name() {
        return name;
    }

    /** Returns older names of the same thing; unmodifiable. */
    public List<String> aliases() {
        return aliases;
    }

    /** Returns the least role that may send it; {@code depends}: a field decides. */
    public String role() {
        return role;
    }

    /** Returns what it is for, one sentence. */
    public String text() {
        return text;
    }

    /** Says whether it needs fresh telemetry, whose beacon it echoes. */
    public boolean needsBeacon() {
        return needsBeacon;
    }

    /** Returns the fields in their order; unmodifiable. */
    public List<CommandField> fields() {
        return fields;
    }

    /** Returns what is wrong with data as JSON values, one sentence that names the field, or null. */
    public String validate(Map<String, ?> data) {
        return null;
    }

    /**
     * Returns the data of what a person typed, by field name; an empty input leaves a field out.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public Map<String, Object> parse(Map<String, String> inputs) {
        return new LinkedHashMap<String, Object>();
    }

    /**
     * Returns the Command of what a person typed.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public BaseCommand command(Map<String, String> inputs) {
        return new BaseCommand(name, parse(inputs));
    }
}
