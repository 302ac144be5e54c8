package org.raspilot.up.loop;

import java.util.ArrayDeque;

/**
 * A loop whose time advances only on request: for tests.
 *
 * <p>Calls run inside {@link #advance}, on the thread that called it. {@link #post} may be called
 * on any thread, everything else only on the one that advances. The network is passed in; when it
 * is a {@link SelectorLoop}, advance on that loop, so that its listeners run there too.
 */
public final class ManualLoop implements Loop {
    private final Network network;
    private final Guard guard;
    private final Object lock = new Object();
    private final ArrayDeque<Runnable> posted = new ArrayDeque<>();
    private final TimerQueue timers = new TimerQueue();
    private volatile long nowMs;

    /**
     * Creates a loop at 0 ms.
     *
     * @param network the result of {@link #network}, or null
     * @param faults receives exceptions of calls on the loop
     */
    public ManualLoop(Network network, FaultListener faults) {
        this.network = network;
        guard = new Guard(faults);
    }

    /**
     * Advances the time by {@code stepMs}, 0 or more: runs posted calls and, in the order of their
     * times, every timer that falls due, each at its own time.
     */
    public void advance(long stepMs) {
        if (stepMs < 0) {
            throw new IllegalArgumentException("time does not go back: " + stepMs);
        }
        final long untilMs = nowMs + stepMs;
        runPosted();
        TimerQueue.Timer timer = timers.take(untilMs, Long.MAX_VALUE);
        while (timer != null) {
            nowMs = timer.time;
            guard.run(timer.call);
            runPosted();
            timer = timers.take(untilMs, Long.MAX_VALUE);
        }
        nowMs = untilMs;
    }

    public int pendingTimers() {
        return timers.size();
    }

    @Override
    public long nowMs() {
        return nowMs;
    }

    @Override
    public void post(Runnable call) {
        synchronized (lock) {
            posted.add(call);
        }
    }

    @Override
    public Cancellable schedule(long delayMs, Runnable call) {
        return timers.add(nowMs + Math.min(Math.max(0, delayMs), Long.MAX_VALUE / 2), call);
    }

    @Override
    public Network network() {
        return network;
    }

    private void runPosted() {
        for (Runnable call = nextPosted(); call != null; call = nextPosted()) {
            guard.run(call);
        }
    }

    private Runnable nextPosted() {
        synchronized (lock) {
            return posted.poll();
        }
    }
}
