package org.raspilot.up.airborne;

import java.util.List;
import org.raspilot.up.commands.CommandReceiver;
import org.raspilot.up.commands.NackCode;
import org.raspilot.up.net.Endpoint;
import org.raspilot.up.net.UpSocketStatus;
import org.raspilot.up.providers.OrientationProvider;
import org.raspilot.up.providers.ProviderStatus;

/** What the airborne screen shows: a snapshot that never changes, for any thread. */
public final class AirborneStatus {
    public final boolean isConnected;
    /** The state of the link in one sentence without a full stop. */
    public final String linkText;
    /** The current or last place of the connection or attempt; null: none so far. */
    public final Endpoint endpoint;
    /** The delay of Panic Mode, ms; 0: none. */
    public final long panicDelayMs;
    /** Each provider, in the order of registration; unmodifiable. */
    public final List<ProviderStatus> providers;
    public final AirborneCounters counters;

    AirborneStatus(UpSocketStatus link, long panicDelayMs, List<ProviderStatus> providers,
            AirborneCounters counters) {
        isConnected = link.isConnected();
        linkText = link.sentence;
        endpoint = link.endpoint;
        this.panicDelayMs = panicDelayMs;
        this.providers = providers;
        this.counters = counters;
    }

    /** Returns how many orientation frames left in the last second. */
    public double orientationHz() {
        for (ProviderStatus provider : providers) {
            if (provider.name.equals(OrientationProvider.NAME)) {
                return provider.rateHz;
            }
        }
        return 0;
    }

    /** The counters of the airborne side since its creation; immutable. */
    public static final class AirborneCounters {
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
}
