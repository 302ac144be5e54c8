package org.raspilot.up.commands;

import java.util.HashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** Which Commands are read into which classes, by name and by alias. */
public final class CommandRegistry {
    private final Map<String, CommandReader> readers = new HashMap<>();
    private final Map<String, String> primaryNames = new HashMap<>();

    public CommandRegistry() {
    }

    /** Returns a registry with the Commands of the Up Library. */
    public static CommandRegistry builtin() {
        CommandRegistry registry = new CommandRegistry();
        Commands.register(registry);
        return registry;
    }

    /**
     * Registers the reader of a Command name, and older names as aliases.
     *
     * @throws IllegalArgumentException when a name is taken
     */
    public void register(String name, CommandReader reader, String... aliases) {
        claim(name, name);
        for (String alias : aliases) {
            claim(alias, name);
        }
        readers.put(name, reader);
    }

    public boolean knows(String name) {
        return primaryNames.containsKey(name);
    }

    /** Returns the name that the Command has today; an unknown name is returned unchanged. */
    public String primaryName(String name) {
        String primary = primaryNames.get(name);
        return primary == null ? name : primary;
    }

    /**
     * Returns the Command that a message is; of an unknown name a plain {@link BaseCommand}.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public BaseCommand read(GeneralMessage message) {
        String name = primaryName(message.name);
        GeneralMessage current = name.equals(message.name) ? message
                : message.with(name, message.id, message.beacon);
        CommandReader reader = readers.get(name);
        return reader == null ? new BaseCommand(current) : reader.read(current);
    }

    private void claim(String name, String primary) {
        if (primaryNames.containsKey(name)) {
            throw new IllegalArgumentException("the Command " + name + " is registered already");
        }
        primaryNames.put(name, primary);
    }

    /** Makes the typed Command of a message; one for each Command, see {@link CommandRegistry}. */
    public interface CommandReader {
        /**
         * Returns the Command that the message is, its fields checked.
         *
         * @throws InvalidCommandException with one sentence that names the field
         */
        BaseCommand read(GeneralMessage message);
    }
}
