package org.raspilot.up.commands;

import java.util.Collections;
import org.raspilot.up.wire.GeneralMessage;

/**
 * Arms the motor; the sender echoes a fresh beacon, and the board decides. Source:
 * docs/protocols.md 5.
 */
public final class ArmCommand extends BaseCommand {
    public static final String NAME = "up.arm";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new ArmCommand(message);

    public ArmCommand() {
        this(new GeneralMessage(NAME, Collections.emptyMap()));
    }

    /** Reads the Command from a message; it has no fields. */
    public ArmCommand(GeneralMessage message) {
        super(NAME, message);
    }
}
