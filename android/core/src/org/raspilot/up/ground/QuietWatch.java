package org.raspilot.up.ground;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;

/** Notices a connection on which nothing comes for longer than {@link QuietLimit} allows. */
final class QuietWatch {
    private final Loop loop;
    private final Owner owner;
    private final QuietLimit limit = new QuietLimit();
    private long heardMs;
    private Cancellable timer;

    interface Owner {
        /** Returns whether the aircraft is connected, or null if unknown. */
        Boolean isAircraftOnline();

        /** Called when nothing was received for that time, ms. */
        void onQuiet(long forMs);
    }

    QuietWatch(Loop loop, Owner owner) {
        this.loop = loop;
        this.owner = owner;
    }

    void start() {
        heardMs = loop.nowMs();
        limit.forget();
        look();
    }

    void stop() {
        if (timer != null) {
            timer.cancel();
        }
    }

    void heard() {
        heardMs = loop.nowMs();
    }

    /** Called when the received line is a message. */
    void heardMessage() {
        limit.heard(heardMs);
    }

    /** Called when the period of telemetry may change. */
    void expectAnotherPeriod() {
        limit.forget();
    }

    private void look() {
        final long limitMs = limit.limitMs(owner.isAircraftOnline());
        final long restMs = heardMs + limitMs - loop.nowMs();
        if (restMs <= 0) {
            owner.onQuiet(limitMs);
            return;
        }
        timer = loop.schedule(Math.min(restMs, QuietLimit.SHORTEST_MS), () -> look());
    }
}
