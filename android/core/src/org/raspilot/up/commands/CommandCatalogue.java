package org.raspilot.up.commands;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.wire.Json;
import org.raspilot.up.wire.MalformedException;

/**
 * Every Command that a ground may send, with its form: the content of {@code commands.json}.
 *
 * <p>The text is the same as for the ground station's page, generated from the Commands.
 */
public final class CommandCatalogue {
    private final List<CommandForm> forms = new ArrayList<>();
    private final Map<String, CommandForm> byName = new LinkedHashMap<>();

    private CommandCatalogue() {
    }

    /**
     * Parses a catalogue: the object {@code {"type": "catalogue", "commands": [...]}}.
     *
     * @throws MalformedException when the text is not a catalogue
     */
    public static CommandCatalogue read(String json) throws MalformedException {
        CommandCatalogue catalogue = new CommandCatalogue();
        for (Object described : CatalogueEntry.of(Json.parse(json)).list("commands")) {
            catalogue.add(new CommandForm(CatalogueEntry.of(described)));
        }
        return catalogue;
    }

    /** Returns the forms in the order of the catalogue, by name; a copy. */
    public List<CommandForm> forms() {
        return new ArrayList<>(forms);
    }

    /** Returns the form of a name or alias, or null. */
    public CommandForm form(String name) {
        return byName.get(name);
    }

    private void add(CommandForm form) {
        forms.add(form);
        byName.put(form.name, form);
        for (String alias : form.aliases) {
            byName.put(alias, form);
        }
    }
}
