package org.raspilot.up.commands;

import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;

/** Requests the gains, or sets all of them (thesis 4.2.4, docs/protocols.md 5). */
public final class PidTuningsCommand extends BaseCommand {
    public static final String NAME = "arduino.pids.tunings";
    /** Reads the Command from a message. */
    public static final CommandReader READER = message -> new PidTuningsCommand(message);

    /** Whether it only requests the gains. */
    public final boolean isRequest;
    /** The set to use, or null for a request. */
    public final GainSet gains;

    /** Creates the Command that requests the gains. */
    public static PidTuningsCommand request() {
        return new PidTuningsCommand(
                new GeneralMessage(NAME, Collections.singletonMap("request", true)));
    }

    /**
     * Creates the Command that sets the gains.
     *
     * @throws InvalidCommandException when a gain is out of its range
     */
    public PidTuningsCommand(GainSet gains) {
        this(new GeneralMessage(NAME, Collections.singletonMap("pids", gains.toData())));
    }

    /**
     * Reads the Command from a message; a set is taken whole or not at all.
     *
     * @throws InvalidCommandException with one sentence that names the place
     */
    public PidTuningsCommand(GeneralMessage message) {
        super(NAME, message);
        CommandFields fields = new CommandFields(message.data);
        isRequest = Boolean.TRUE.equals(fields.optionalFlag("request"));
        Map<String, Object> pids = fields.optionalObject("pids");
        if (!isRequest && pids == null) {
            throw new InvalidCommandException("either request or pids is needed");
        }
        gains = isRequest ? null : GainSet.ofData(new LinkedHashMap<>(pids));
    }
}
