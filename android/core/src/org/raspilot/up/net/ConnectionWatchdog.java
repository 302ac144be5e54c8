package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;
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

    /**
     * Fires once when it was not touched for a time. A touch is cheap: it does not reschedule.
     *
     * <p>After a phone has slept, the timer is due before the data received during the sleep is
     * read. The loop reads between two timers, so the decision is made at a second check.
     */
    private static final class IdleTimer {
        private final Loop loop;
        private final long limitMs;
        private final Runnable onIdle;
        private final Runnable check = () -> check();
        private Cancellable timer;
        private long touchedMs;
        private boolean isSecondLook;

        IdleTimer(Loop loop, long limitMs, Runnable onIdle) {
            this.loop = loop;
            this.limitMs = limitMs;
            this.onIdle = onIdle;
        }

        /** Restarts the timer; a limit of 0 disables it. */
        void start() {
            stop();
            reset();
            if (limitMs > 0) {
                checkAfter(limitMs, false);
            }
        }

        void stop() {
            if (timer != null) {
                timer.cancel();
                timer = null;
            }
        }

        /** Notes that the awaited event has happened now. */
        void reset() {
            touchedMs = loop.nowMs();
        }

        boolean isRunning() {
            return timer != null;
        }

        private void check() {
            final long restMs = touchedMs + limitMs - loop.nowMs();
            if (restMs > 0) {
                checkAfter(restMs, false);
            } else if (!isSecondLook) {
                checkAfter(0, true);
            } else {
                timer = null;
                onIdle.run();
            }
        }

        private void checkAfter(long delayMs, boolean isSecond) {
            isSecondLook = isSecond;
            timer = loop.schedule(delayMs, check);
        }
    }
}
