package org.raspilot.up.commands;

import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.wire.MalformedException;

/** Every Command that some ground may send, with its form: what {@code commands.json} says. */
public final class CommandCatalogue {
    private final List<CommandForm> forms;

    private CommandCatalogue(List<CommandForm> forms) {
        this.forms = forms;
    }

    /**
     * Reads the text of a catalogue: the object {@code {"type": "catalogue", "commands": [...]}}.
     *
     * @throws MalformedException when it is none
     */
    public static CommandCatalogue read(String json) throws MalformedException {
        return new CommandCatalogue(new ArrayList<CommandForm>());
    }

    /** Returns the forms by name; a copy. */
    public List<CommandForm> forms() {
        return new ArrayList<CommandForm>(forms);
    }

    /** Returns the form of a name or alias, or null. */
    public CommandForm form(String name) {
        return null;
    }
}
