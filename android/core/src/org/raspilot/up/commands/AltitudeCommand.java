package org.raspilot.up.commands;

import java.util.Arrays;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** An altitude above sea level, measured or requested. Source: docs/protocols.md 5. */
public final class AltitudeCommand extends BaseCommand {
    public static final String NAME = "up.altitude.change";
    public static final List<String> MODES =
            Collections.unmodifiableList(Arrays.asList("actual", "required"));
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new AltitudeCommand(message);

    public final double altitudeM;
    /** {@code actual} for a measured value, {@code required} for a requested one. */
    public final String mode;

    /**
     * Creates the Command.
     *
     * @throws InvalidCommandException when a value is out of its range
     */
    public AltitudeCommand(double altitudeM, String mode) {
        this(new GeneralMessage(NAME, data(altitudeM, mode)));
    }

    /**
     * Reads the Command from a message.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public AltitudeCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        altitudeM = fields.number("altitude", -1000, 30000);
        mode = fields.choice("mode", MODES, "actual");
    }

    private static Map<String, Object> data(double altitudeM, String mode) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("altitude", altitudeM);
        data.put("mode", mode);
        return data;
    }
}
