package org.raspilot.up.commands;

import java.util.Arrays;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/**
 * A flight mode; accepted only while the pilot's switch is at AUTO, and never ACRO. Source:
 * docs/protocols.md 5.
 */
public final class FlightModeCommand extends BaseCommand {
    public static final String NAME = "up.flight_mode.set";
    /** The modes that may be requested. */
    public static final List<String> MODES =
            Collections.unmodifiableList(Arrays.asList("RATE", "FBW", "AUTO"));
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new FlightModeCommand(message);

    public final String mode;

    /**
     * Creates the Command.
     *
     * @throws InvalidCommandException when a value is out of its range
     */
    public FlightModeCommand(String mode) {
        this(new GeneralMessage(NAME, data(mode)));
    }

    /**
     * Reads the Command from a message.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public FlightModeCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        mode = fields.choice("mode", MODES);
    }

    private static Map<String, Object> data(String mode) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("mode", mode);
        return data;
    }
}
