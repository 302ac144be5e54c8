package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;

/**
 * Tells once that nothing has touched it for a time. A touch is free: it moves no timer.
 *
 * <p>A phone that slept finds the time over before it has read what came meanwhile: the loop reads
 * between two timers, so the decision falls at a second look.
 */
final class IdleTimer {
    private final Loop loop;
    private final long limitMs;
    private final Runnable onIdle;
    private final Runnable look = new Runnable() {
        @Override
        public void run() {
            look();
        }
    };
    private Cancellable timer;
    private long touchedMs;
    private boolean isSecondLook;

    IdleTimer(Loop loop, long limitMs, Runnable onIdle) {
        this.loop = loop;
        this.limitMs = limitMs;
        this.onIdle = onIdle;
    }

    /** Begins anew; a limit of 0 is none. */
    void start() {
        stop();
        touch();
        if (limitMs > 0) {
            lookAfter(limitMs, false);
        }
    }

    /** Ends; it may be started again. */
    void stop() {
        if (timer != null) {
            timer.cancel();
        }
    }

    /** Takes that what is waited for has happened now. */
    void touch() {
        touchedMs = loop.nowMs();
    }

    boolean isRunning() {
        return timer != null && timer.isPending();
    }

    private void look() {
        final long restMs = touchedMs + limitMs - loop.nowMs();
        if (restMs > 0) {
            lookAfter(restMs, false);
        } else if (!isSecondLook) {
            lookAfter(0, true);
        } else {
            onIdle.run();
        }
    }

    private void lookAfter(long delayMs, boolean isSecond) {
        isSecondLook = isSecond;
        timer = loop.schedule(delayMs, look);
    }
}
