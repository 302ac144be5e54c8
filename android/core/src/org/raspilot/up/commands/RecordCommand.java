package org.raspilot.up.commands;

import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** An object for the flight log, under its own topic. Source: docs/protocols.md 5. */
public final class RecordCommand extends BaseCommand {
    public static final String NAME = "black_box.record";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new RecordCommand(message);

    /** The topic, words joined by dots. */
    public final String topic;
    /** The recorded object; at most 4 KiB as JSON. Unmodifiable. */
    public final Map<String, Object> content;

    /**
     * Creates the Command.
     *
     * @throws InvalidCommandException when a value is out of its range
     */
    public RecordCommand(String topic, Map<String, Object> content) {
        this(new GeneralMessage(NAME, data(topic, content)));
    }

    /**
     * Reads the Command from a message.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public RecordCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        topic = fields.topic("topic");
        content = fields.object("content");
    }

    private static Map<String, Object> data(String topic, Map<String, Object> content) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("topic", topic);
        data.put("content", content);
        return data;
    }
}
