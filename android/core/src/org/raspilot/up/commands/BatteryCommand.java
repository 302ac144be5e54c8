package org.raspilot.up.commands;

import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** The level of the phone's battery. Source: docs/protocols.md 5. */
public final class BatteryCommand extends BaseCommand {
    public static final String NAME = "android.battery";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new BatteryCommand(message);

    public final double levelPercent;

    /**
     * Creates the Command.
     *
     * @throws InvalidCommandException when a value is out of its range
     */
    public BatteryCommand(double levelPercent) {
        this(new GeneralMessage(NAME, data(levelPercent)));
    }

    /**
     * Reads the Command from a message.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public BatteryCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        levelPercent = fields.number("level", 0, 100);
    }

    private static Map<String, Object> data(double levelPercent) {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("level", levelPercent);
        return data;
    }
}
