package org.raspilot.up.commands;

import java.util.Arrays;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** A heading clockwise from north, measured or requested. Source: docs/protocols.md 5. */
public final class HeadingCommand extends BaseCommand {
    public static final String NAME = "up.heading.change";
    public static final List<String> MODES =
            Collections.unmodifiableList(Arrays.asList("actual", "required"));
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new HeadingCommand(message);

    public final double headingDeg;
    /** {@code actual} for a measured value, {@code required} for a requested one. */
    public final String mode;

    /**
     * Creates the Command.
     *
     * @throws InvalidCommandException when a value is out of its range
     */
    public HeadingCommand(double headingDeg, String mode) {
        this(new GeneralMessage(NAME, data(headingDeg, mode)));
    }

    /**
     * Reads the Command from a message.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public HeadingCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        headingDeg = fields.number("heading", -360, 360);
        mode = fields.choice("mode", MODES);
    }

    private static Map<String, Object> data(double headingDeg, String mode) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("heading", headingDeg);
        data.put("mode", mode);
        return data;
    }
}
