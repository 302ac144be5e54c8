package org.raspilot.up.commands;

import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** The Command of an id was carried out. Source: docs/protocols.md 4. */
public final class AckCommand extends BaseCommand {
    public static final String NAME = "up.ack";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new AckCommand(message);

    /** The id of the Command that is answered. */
    public final String commandId;

    /**
     * Creates the Command.
     *
     * @throws InvalidCommandException when a value is out of its range
     */
    public AckCommand(String commandId) {
        this(new GeneralMessage(NAME, data(commandId)));
    }

    /**
     * Reads the Command from a message.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public AckCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        commandId = fields.text("id", GeneralMessage.LONGEST_ID);
    }

    private static Map<String, Object> data(String commandId) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("id", commandId);
        return data;
    }
}
