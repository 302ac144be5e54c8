package org.raspilot.up.commands;

import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/**
 * Enters or leaves Panic Mode: every sender keeps a period of at least {@link #delayMs}. Source:
 * docs/protocols.md 5.
 */
public final class PanicCommand extends BaseCommand {
    public static final String NAME = "up.panic";
    /** An older name of this Command. */
    public static final String ALIAS = "load_guard.panic";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new PanicCommand(message);

    public final boolean panic;
    /** The shortest period in ms, 0 to 10000. */
    public final long delayMs;
    /** The load in percent, or null. */
    public final Double utilizationPercent;

    /**
     * Creates the Command; null values are left out.
     *
     * @throws InvalidCommandException when a value is out of its range
     */
    public PanicCommand(boolean panic, long delayMs, Double utilizationPercent) {
        this(new GeneralMessage(NAME, data(panic, delayMs, utilizationPercent)));
    }

    /**
     * Reads the Command from a message.
     *
     * @throws InvalidCommandException with one sentence that names the field
     */
    public PanicCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        panic = fields.flag("panic");
        // An older Raspberry Pi sends 0 and fractions; rounding up never shortens a period.
        delayMs = (long) Math.ceil(fields.number("delay_ms", 0, 10000));
        utilizationPercent = fields.optionalNumber("utilization", 0, 100);
    }

    private static Map<String, Object> data(boolean panic, long delayMs, Double utilizationPercent)
            {
        Map<String, Object> data = new LinkedHashMap<>();
        data.put("panic", panic);
        data.put("delay_ms", delayMs);
        if (utilizationPercent != null) {
            data.put("utilization", utilizationPercent);
        }
        return data;
    }
}
