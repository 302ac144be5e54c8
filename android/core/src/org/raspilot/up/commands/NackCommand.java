package org.raspilot.up.commands;

import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** The Command of an id was not carried out, and why. Source: docs/protocols.md 4. */
public final class NackCommand extends BaseCommand {
    public static final String NAME = "up.nack";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new NackCommand(message);

    /** The id of the Command that is answered. */
    public final String commandId;
    /** The code's word; see {@link NackCode#ofWord} for the current ones. */
    public final String code;
    public final String reason;

    /**
     * Creates the Command.
     *
     * @throws InvalidCommandException when a value is out of its range
     */
    public NackCommand(String commandId, String code, String reason) {
        this(new GeneralMessage(NAME, data(commandId, code, reason)));
    }

    /**
     * Reads the Command from a message.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public NackCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        commandId = fields.text("id", GeneralMessage.LONGEST_ID);
        code = fields.text("code", 32);
        reason = fields.text("reason", 500, "");
    }

    private static Map<String, Object> data(String commandId, String code, String reason) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("id", commandId);
        data.put("code", code);
        data.put("reason", reason);
        return data;
    }
}
