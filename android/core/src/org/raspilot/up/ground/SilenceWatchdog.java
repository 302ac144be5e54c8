package org.raspilot.up.ground;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;

/** Notices a connection on which nothing comes for longer than {@link SilenceLimit} allows. */
final class SilenceWatchdog {
    private final Loop loop;
    private final LinkStatus facts;
    private final QuietListener listener;
    private final SilenceLimit limit = new SilenceLimit();
    private long receivedAtMs;
    private Cancellable timer = Cancellable.DONE;

    interface QuietListener {
        /** Called when nothing was received for that time, ms. */
        void onQuiet(long forMs);
    }

    SilenceWatchdog(Loop loop, LinkStatus facts, QuietListener listener) {
        this.loop = loop;
        this.facts = facts;
        this.listener = listener;
    }

    void start() {
        receivedAtMs = loop.nowMs();
        limit.reset();
        check();
    }

    void stop() {
        timer.cancel();
    }

    void onLine() {
        receivedAtMs = loop.nowMs();
    }

    /** Called when the received line is a message. */
    void onMessage() {
        limit.onMessage(receivedAtMs);
    }

    /** Called when the period of telemetry may change. */
    void expectAnotherPeriod() {
        limit.reset();
    }

    private void check() {
        // Without a session the aircraft sends nothing but replies to hellos.
        final long limitMs = limit.limitMs(
                facts.keyFault().isEmpty() ? facts.isAircraftOnline : Boolean.FALSE);
        final long restMs = receivedAtMs + limitMs - loop.nowMs();
        if (restMs <= 0) {
            listener.onQuiet(limitMs);
            return;
        }
        timer = loop.schedule(Math.min(restMs, SilenceLimit.MIN_MS), () -> check());
    }

    /**
     * Sets how long a link to a proxy may stay without a byte before it counts as dead.
     *
     * <p>A proxy sends no heartbeat, so telemetry is the only traffic and the limit follows its
     * period. When a phone leaves its network, the system may not report it for minutes.
     */
    static final class SilenceLimit {
        /** The minimum, ms: the proxy reports a silent aircraft within 3 s. */
        static final long MIN_MS = 4000;
        /** Longer than telemetry's longest period (10 s). */
        static final long UNKNOWN_MS = 12000;
        /** Without the aircraft no traffic is expected; hellos are cheap. */
        static final long OFFLINE_MS = 30000;

        private static final int GAPS = 8;
        private static final int FACTOR = 5;

        private final long[] gapsMs = new long[GAPS];
        private int count;
        private Long receivedAtMs;

        /** Called when the telemetry's period may change, or the link is another one. */
        void reset() {
            count = 0;
            receivedAtMs = null;
        }

        void onMessage(long nowMs) {
            if (receivedAtMs != null) {
                gapsMs[count % GAPS] = nowMs - receivedAtMs;
                count++;
            }
            receivedAtMs = nowMs;
        }

        /** Returns the limit, ms; {@code isOnline} is null if unknown. */
        long limitMs(Boolean isOnline) {
            if (Boolean.FALSE.equals(isOnline)) {
                return OFFLINE_MS;
            }
            if (count < GAPS) {
                return UNKNOWN_MS;
            }
            long longestMs = 0;
            for (long each : gapsMs) {
                longestMs = Math.max(longestMs, each);
            }
            return Math.max(MIN_MS, Math.min(UNKNOWN_MS, FACTOR * longestMs));
        }
    }
}
