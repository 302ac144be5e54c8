package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;

/**
 * Watches one connection: asks for a heartbeat after own silence, and gives the connection up when
 * the peer says nothing, or takes nothing of what waits, for too long.
 */
final class LinkWatch {
    private final Loop loop;
    private final UpSocketSettings settings;
    private final Owner owner;
    private Cancellable beat;
    private Cancellable silence;
    private Cancellable stall;
    private long wroteMs;
    private long heardMs;
    private long movedMs;

    LinkWatch(Loop loop, UpSocketSettings settings, Owner owner) {
        this.loop = loop;
        this.settings = settings;
        this.owner = owner;
    }

    /** Begins with a new connection. */
    void start() {
        stop();
        wroteMs = loop.nowMs();
        heardMs = wroteMs;
        if (settings.heartbeatMs() > 0) {
            scheduleBeat(settings.heartbeatMs());
        }
        if (settings.silenceLimitMs() > 0) {
            scheduleSilence(settings.silenceLimitMs());
        }
    }

    /** Ends with the connection. */
    void stop() {
        cancel(beat);
        cancel(silence);
        cancel(stall);
    }

    /** Hears that bytes came. */
    void heard() {
        heardMs = loop.nowMs();
    }

    /** Hears that something was given to the connection: how much it took, what still waits. */
    void wrote(long bytes, boolean isWaiting) {
        if (bytes > 0) {
            wroteMs = loop.nowMs();
        }
        if (settings.stallLimitMs() == 0) {
            return;
        }
        if (!isWaiting) {
            cancel(stall);
        } else if (bytes > 0 || stall == null || !stall.isPending()) {
            movedMs = loop.nowMs();
            if (stall == null || !stall.isPending()) {
                scheduleStall(settings.stallLimitMs());
            }
        }
    }

    private void scheduleBeat(long delayMs) {
        beat = loop.schedule(delayMs, new Runnable() {
            @Override
            public void run() {
                long restMs = wroteMs + settings.heartbeatMs() - loop.nowMs();
                if (restMs <= 0) {
                    restMs = settings.heartbeatMs();
                    scheduleBeat(restMs);
                    owner.onBeat();
                } else {
                    scheduleBeat(restMs);
                }
            }
        });
    }

    private void scheduleSilence(long delayMs) {
        silence = loop.schedule(delayMs, new Runnable() {
            @Override
            public void run() {
                final long restMs = heardMs + settings.silenceLimitMs() - loop.nowMs();
                if (restMs > 0) {
                    scheduleSilence(restMs);
                } else {
                    decideSilence();
                }
            }
        });
    }

    /**
     * A phone that slept finds the time over before it has read what came meanwhile: the loop reads
     * between two timers, so the decision falls at the second.
     */
    private void decideSilence() {
        silence = loop.schedule(0, new Runnable() {
            @Override
            public void run() {
                final long restMs = heardMs + settings.silenceLimitMs() - loop.nowMs();
                if (restMs > 0) {
                    scheduleSilence(restMs);
                } else {
                    owner.onGivenUp("said nothing for " + settings.silenceLimitMs() + " ms");
                }
            }
        });
    }

    private void scheduleStall(long delayMs) {
        stall = loop.schedule(delayMs, new Runnable() {
            @Override
            public void run() {
                final long restMs = movedMs + settings.stallLimitMs() - loop.nowMs();
                if (restMs > 0) {
                    scheduleStall(restMs);
                } else {
                    owner.onGivenUp("took nothing for " + settings.stallLimitMs() + " ms");
                }
            }
        });
    }

    private static void cancel(Cancellable timer) {
        if (timer != null) {
            timer.cancel();
        }
    }

    /** Who does what the watch decides. */
    interface Owner {
        /** Sends a heartbeat. */
        void onBeat();

        /** Ends the connection; {@code what} the peer did, without its name. */
        void onGivenUp(String what);
    }
}
