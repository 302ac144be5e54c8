package org.raspilot.up.commands;

import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** One frame of telemetry; its beacon travels beside its content (docs/protocols.md 6). */
public final class TelemetryCommand extends BaseCommand {
    public static final String NAME = "up.telemetry.update";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new TelemetryCommand(message);

    /** Creates a frame with that content; {@code beacon} null: none. */
    public TelemetryCommand(Map<String, ?> content, Long beacon) {
        this(new GeneralMessage(NAME, content, null, beacon));
    }

    /** Reads the frame from a message: any content is telemetry. */
    public TelemetryCommand(GeneralMessage message) {
        super(NAME, message);
    }
}
