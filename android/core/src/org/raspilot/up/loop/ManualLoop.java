package org.raspilot.up.loop;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.List;

/**
 * A loop whose time stands still until it is told to pass: for tests and for a stepped program.
 *
 * <p>Calls run inside {@link #advance}, on the thread that called it. {@link #post} may be called on
 * any thread, everything else only on the one that advances. The network is handed in; when it is
 * a {@link SelectorLoop}'s, advance on that loop, so that its listeners run there too.
 */
public final class ManualLoop implements Loop {
    private final Network network;
    private final FaultListener faultListener;
    private final Object lock = new Object();
    private final ArrayDeque<Runnable> posted = new ArrayDeque<Runnable>();
    private final List<Timer> timers = new ArrayList<Timer>();
    private volatile long nowMs;
    private volatile Thread thread = Thread.currentThread();
    private volatile long faults;
    private long sequence;

    /**
     * Makes a loop at 0 ms.
     *
     * @param network what {@link #network} returns; null where none is needed
     * @param faultListener hears of exceptions of what runs on the loop
     */
    public ManualLoop(Network network, FaultListener faultListener) {
        this.network = network;
        this.faultListener = faultListener;
    }

    /**
     * Lets {@code stepMs} pass, 0 or more: runs what was posted and, in the order of their times,
     * every timer that falls due, each at its own time.
     */
    public void advance(long stepMs) {
        if (stepMs < 0) {
            throw new IllegalArgumentException("time does not go back: " + stepMs);
        }
        thread = Thread.currentThread();
        final long untilMs = nowMs + stepMs;
        runPosted();
        for (Timer next = due(untilMs); next != null; next = due(untilMs)) {
            nowMs = Math.max(nowMs, next.timeMs);
            timers.remove(next);
            guard(next.call);
            runPosted();
        }
        nowMs = untilMs;
    }

    /** Returns how many calls threw. */
    public long faults() {
        return faults;
    }

    /** Returns how many timers wait. */
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
        final Timer timer = new Timer(nowMs + Math.max(0, delayMs), sequence++, call);
        timers.add(timer);
        return timer;
    }

    @Override
    public boolean isInLoop() {
        return Thread.currentThread() == thread;
    }

    @Override
    public Network network() {
        return network;
    }

    private void runPosted() {
        for (Runnable call = nextPosted(); call != null; call = nextPosted()) {
            guard(call);
        }
    }

    private Runnable nextPosted() {
        synchronized (lock) {
            return posted.poll();
        }
    }

    private Timer due(long untilMs) {
        Timer first = null;
        for (Timer timer : timers) {
            if (timer.timeMs <= untilMs && (first == null || timer.isBefore(first))) {
                first = timer;
            }
        }
        return first;
    }

    /** Whatever a call throws is told and counted: one part's fault must not end the others. */
    private void guard(Runnable call) {
        try {
            call.run();
        } catch (RuntimeException fault) {
            faults++;
            faultListener.onFault(fault);
        }
    }

    private final class Timer implements Cancellable {
        private final long timeMs;
        private final long order;
        private final Runnable call;

        Timer(long timeMs, long order, Runnable call) {
            this.timeMs = timeMs;
            this.order = order;
            this.call = call;
        }

        boolean isBefore(Timer other) {
            return timeMs != other.timeMs ? timeMs < other.timeMs : order < other.order;
        }

        @Override
        public void cancel() {
            timers.remove(this);
        }

        @Override
        public boolean isPending() {
            return timers.contains(this);
        }
    }
}
