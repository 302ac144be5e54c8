package org.raspilot.up.airborne;

import org.raspilot.up.commands.CommandReceiver;
import org.raspilot.up.commands.NackCode;

/** The counters of the airborne side since its creation; immutable. */
public final class AirborneCounters {
    public final long connections;
    public final long telemetry;
    public final long executed;
    public final long refused;
    public final long malformed;

    /** Takes the current counts; answers are those to messages sent with an id. */
    AirborneCounters(CommandReceiver receiver, long connections, long telemetry, long answers) {
        this.connections = connections;
        this.telemetry = telemetry;
        malformed = receiver.count(NackCode.MALFORMED.word());
        long others = 0;
        for (NackCode code : NackCode.values()) {
            others += code == NackCode.MALFORMED ? 0 : receiver.count(code.word());
        }
        refused = others;
        executed = receiver.count("received") - receiver.count("repeated") - refused - telemetry
                - answers;
    }
}
