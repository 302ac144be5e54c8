package org.raspilot.up.loop;

import java.util.PriorityQueue;

/** Timers in the order of their due times; those of equal time in the order of scheduling. */
final class TimerQueue {
    /** By differences, as the clock's beginning is arbitrary and it may run over. */
    private final PriorityQueue<Timer> timers = new PriorityQueue<>(16, (one, other) -> {
        final long apart = one.time - other.time;
        return Long.signum(apart != 0 ? apart : one.order - other.order);
    });
    private long asked;

    /** Adds a timer that falls due at {@code time}, in whatever unit the caller keeps time. */
    Cancellable add(long time, Runnable call) {
        final Timer timer = new Timer(time, asked++, call);
        timers.add(timer);
        return timer;
    }

    /** Returns a mark: timers that are added later are not taken by it. */
    long mark() {
        return asked;
    }

    /**
     * Removes and returns the first timer that is due at {@code now} and was added before {@code
     * mark}, or null. A timer that adds another without delay cannot starve others.
     */
    Timer take(long now, long mark) {
        final Timer first = timers.peek();
        if (first == null || first.time - now > 0 || first.order >= mark) {
            return null;
        }
        first.isPending = false;
        return timers.poll();
    }

    /** Returns the first timer; null: none waits. */
    Timer first() {
        return timers.peek();
    }

    int size() {
        return timers.size();
    }

    final class Timer implements Cancellable {
        final long time;
        final Runnable call;
        private final long order;
        private boolean isPending = true;

        private Timer(long time, long order, Runnable call) {
            this.time = time;
            this.order = order;
            this.call = call;
        }

        @Override
        public void cancel() {
            if (isPending) {
                isPending = false;
                timers.remove(this);
            }
        }
    }
}
