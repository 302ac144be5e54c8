package org.raspilot.up.commands;

import org.raspilot.up.wire.GeneralMessage;

/** Which Commands are read into which classes, by name and by alias. */
public final class CommandRegistry {
    /** Makes an empty registry. */
    public CommandRegistry() {
    }

    /** Returns a registry with the Commands of the Up Library. */
    public static CommandRegistry builtin() {
        return new CommandRegistry();
    }

    /**
     * Says which reader makes the Commands of a name, which older names mean the same.
     *
     * @throws IllegalArgumentException when a name is taken
     */
    public void register(String name, CommandReader reader, String... aliases) {
    }

    /** Says whether a name or alias is known. */
    public boolean knows(String name) {
        return false;
    }

    /** Returns the name that the Command has today; an unknown name is returned unchanged. */
    public String primaryName(String name) {
        return name;
    }

    /**
     * Returns the Command that a message is; of an unknown name a plain {@link BaseCommand}.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public BaseCommand read(GeneralMessage message) {
        return new BaseCommand(message);
    }
}
