package org.raspilot.up.commands;

import org.raspilot.up.wire.GeneralMessage;

/** Makes the typed Command of a message; one for each Command, see {@link CommandRegistry}. */
public interface CommandReader {
    /**
     * Returns the Command that the message is, its fields checked.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    BaseCommand read(GeneralMessage message);
}
