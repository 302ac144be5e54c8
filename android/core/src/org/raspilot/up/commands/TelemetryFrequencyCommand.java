package org.raspilot.up.commands;

import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/**
 * The period of telemetry that the ground requests; the prototype called it a frequency. Source:
 * docs/protocols.md 5.
 */
public final class TelemetryFrequencyCommand extends BaseCommand {
    public static final String NAME = "up.telemetry.frequency";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new TelemetryFrequencyCommand(message);

    public final double periodMs;

    /**
     * Creates the Command.
     *
     * @throws InvalidCommandException when a value is out of its range
     */
    public TelemetryFrequencyCommand(double periodMs) {
        this(new GeneralMessage(NAME, data(periodMs)));
    }

    /**
     * Reads the Command from a message.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public TelemetryFrequencyCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        periodMs = fields.number("frequency", 20, 10000);
    }

    private static Map<String, Object> data(double periodMs) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("frequency", periodMs);
        return data;
    }
}
