package org.raspilot.up.ground;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;

/** Notices a connection on which nothing comes for longer than {@link SilenceLimit} allows. */
final class SilenceWatchdog {
    private final Loop loop;
    private final Owner owner;
    private final SilenceLimit limit = new SilenceLimit();
    private long receivedAtMs;
    private Cancellable timer;

    interface Owner {
        /** Returns whether the aircraft is connected, or null if unknown. */
        Boolean isAircraftOnline();

        /** Called when nothing was received for that time, ms. */
        void onQuiet(long forMs);
    }

    SilenceWatchdog(Loop loop, Owner owner) {
        this.loop = loop;
        this.owner = owner;
    }

    void start() {
        receivedAtMs = loop.nowMs();
        limit.reset();
        check();
    }

    void stop() {
        if (timer != null) {
            timer.cancel();
        }
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
        final long limitMs = limit.limitMs(owner.isAircraftOnline());
        final long restMs = receivedAtMs + limitMs - loop.nowMs();
        if (restMs <= 0) {
            owner.onQuiet(limitMs);
            return;
        }
        timer = loop.schedule(Math.min(restMs, SilenceLimit.MIN_MS), () -> check());
    }
}
