package org.raspilot.up.commands;

import java.util.Collections;
import org.raspilot.up.wire.GeneralMessage;

/**
 * Disarms the motor; refused unless the throttle has been low for 2 s. Source: docs/protocols.md 5.
 */
public final class DisarmCommand extends BaseCommand {
    public static final String NAME = "up.disarm";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new DisarmCommand(message);

    public DisarmCommand() {
        this(new GeneralMessage(NAME, Collections.emptyMap()));
    }

    /** Reads the Command from a message; it has no fields. */
    public DisarmCommand(GeneralMessage message) {
        super(NAME, message);
    }
}
