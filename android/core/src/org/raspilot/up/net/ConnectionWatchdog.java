package org.raspilot.up.net;

import org.raspilot.up.loop.Loop;

/**
 * Watches one connection: requests a heartbeat after own silence, and reports a peer that accepts
 * no waiting data for too long.
 */
final class ConnectionWatchdog {
    private final IdleTimer beat;
    private final IdleTimer stall;

    ConnectionWatchdog(Loop loop, UpSocketSettings settings, Runnable onBeat, Runnable onStalled) {
        beat = new IdleTimer(loop, settings.heartbeatMs, () -> beat(onBeat));
        stall = new IdleTimer(loop, settings.stallLimitMs, onStalled);
    }

    private void beat(Runnable onBeat) {
        beat.start();
        onBeat.run();
    }

    void start() {
        stop();
        beat.start();
    }

    void stop() {
        beat.stop();
        stall.stop();
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
}
