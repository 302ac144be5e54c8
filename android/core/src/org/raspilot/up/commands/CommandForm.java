package org.raspilot.up.commands;

import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.MalformedException;

/** A Command as a person fills it in: its name, what it is for, its fields. */
public final class CommandForm {
    public final String name;
    /** Older names of the Command; unmodifiable. */
    public final List<String> aliases;
    /** What it is for, one sentence. */
    public final String text;
    private final String role;
    private final List<SpecialRole> specialRoles = new ArrayList<>();
    private final Map<String, CommandField> fields = new LinkedHashMap<>();

    CommandForm(CatalogueEntry entry) throws MalformedException {
        name = entry.text("name");
        role = entry.text("role");
        text = entry.text("text");
        List<String> names = new ArrayList<>();
        for (Object alias : entry.list("aliases")) {
            names.add(String.valueOf(alias));
        }
        aliases = Collections.unmodifiableList(names);
        for (Object special : entry.list("role_where")) {
            specialRoles.add(new SpecialRole(CatalogueEntry.of(special)));
        }
        for (Object described : entry.list("fields")) {
            CommandField field = new CommandField(CatalogueEntry.of(described));
            fields.put(field.name, field);
        }
    }

    /** Returns the least role that may send it with such data; empty: no ground may. */
    public String role(Map<String, ?> data) {
        for (SpecialRole special : specialRoles) {
            if (special.value.equals(data.get(special.field))) {
                return special.role;
            }
        }
        return role;
    }

    /** Returns the fields in their order; a copy. */
    public List<CommandField> fields() {
        return new ArrayList<>(fields.values());
    }

    /** Returns the field of a name, or null. */
    public CommandField field(String fieldName) {
        return fields.get(fieldName);
    }

    /** Throws InvalidCommandException unless JSON data are valid. */
    public void check(Map<String, ?> data) {
        for (Map.Entry<String, ?> given : data.entrySet()) {
            CommandField field = fields.get(given.getKey());
            if (field == null) {
                throw new InvalidCommandException("unknown", given.getKey(),
                        "is not a field of " + name);
            }
            field.check(given.getValue());
        }
        for (CommandField field : fields.values()) {
            if (field.isRequired() && !data.containsKey(field.name)) {
                throw new InvalidCommandException("missing", field.name, "is missing");
            }
        }
    }

    /**
     * Returns the data of what a person typed, by field name; an empty input leaves a field out.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public Map<String, Object> parse(Map<String, String> inputs) {
        Map<String, Object> data = new LinkedHashMap<>();
        for (Map.Entry<String, String> input : inputs.entrySet()) {
            String typed = input.getValue();
            if (typed != null && typed.trim().length() > 0) {
                CommandField field = fields.get(input.getKey());
                data.put(input.getKey(), field == null ? typed : field.parse(typed));
            }
        }
        check(data);
        return data;
    }

    /**
     * Builds the Command from typed text; a Command that the Up Library knows is also validated as
     * a whole.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public BaseCommand command(Map<String, String> inputs) {
        return CommandRegistry.builtin().read(new GeneralMessage(name, parse(inputs)));
    }

    private static final class SpecialRole {
        final String field;
        final Object value;
        final String role;

        SpecialRole(CatalogueEntry entry) throws MalformedException {
            field = entry.text("field");
            value = entry.value("value");
            role = entry.text("role");
        }
    }
}
