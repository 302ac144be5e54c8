package org.raspilot.up.commands;

import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** A mark in the flight log, with a text from its sender. Source: docs/protocols.md 5. */
public final class MarkCommand extends BaseCommand {
    public static final String NAME = "black_box.mark";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new MarkCommand(message);

    /** The text, 1 to 200 characters. */
    public final String text;

    /**
     * Creates the Command.
     *
     * @throws InvalidCommandException when a value is out of its range
     */
    public MarkCommand(String text) {
        this(new GeneralMessage(NAME, data(text)));
    }

    /**
     * Reads the Command from a message.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public MarkCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        text = fields.inkedText("text", 200);
    }

    private static Map<String, Object> data(String text) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("text", text);
        return data;
    }
}
