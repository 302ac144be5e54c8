package org.raspilot.up.net;

import org.raspilot.up.loop.Loop;

/**
 * Watches one connection: requests a heartbeat after own silence, and closes the connection when
 * for too long the peer sends nothing, or accepts no waiting data.
 */
final class ConnectionWatchdog {
    private final IdleTimer beat;
    private final IdleTimer silence;
    private final IdleTimer stall;

    ConnectionWatchdog(Loop loop, UpSocketSettings settings, final Owner owner) {
        beat = new IdleTimer(loop, settings.heartbeatMs, () -> beat(owner));
        silence = timeout(loop, settings.silenceLimitMs, "said nothing", owner);
        stall = timeout(loop, settings.stallLimitMs, "took nothing", owner);
    }

    private void beat(Owner owner) {
        beat.start();
        owner.onBeat();
    }

    void start() {
        stop();
        beat.start();
        silence.start();
    }

    void stop() {
        beat.stop();
        silence.stop();
        stall.stop();
    }

    /** Called when bytes arrive. */
    void onReceived() {
        silence.reset();
    }

    /** Called after a write: how much the connection accepted, and how much still waits. */
    void onWritten(long bytes, boolean isWaiting) {
        if (bytes > 0) {
            beat.reset();
        }
        if (!isWaiting) {
            stall.stop();
        } else if (!stall.isRunning()) {
            stall.start();
        } else if (bytes > 0) {
            stall.reset();
        }
    }

    private static IdleTimer timeout(Loop loop, final long limitMs, final String what,
            final Owner owner) {
        return new IdleTimer(loop, limitMs, () ->
                owner.onTimeout(what + " for " + limitMs + " ms"));
    }

    /** Who does what the watch decides. */
    interface Owner {
        void onBeat();

        /** Closes the connection; {@code what} the peer did, without its name. */
        void onTimeout(String what);
    }
}
