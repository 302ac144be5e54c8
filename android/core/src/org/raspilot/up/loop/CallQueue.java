package org.raspilot.up.loop;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

/** The calls that wait for a loop, in their order. On any thread. */
final class CallQueue {
    private List<Runnable> waiting = new ArrayList<>();
    private boolean isClosed;

    /** Queues a call; returns whether it is the only one, for which the loop must wake. */
    synchronized boolean add(Runnable call) {
        if (isClosed) {
            return false;
        }
        waiting.add(call);
        return waiting.size() == 1;
    }

    /** Returns those that wait; they wait no more. */
    synchronized List<Runnable> drain() {
        if (waiting.isEmpty()) {
            return Collections.emptyList();
        }
        final List<Runnable> taken = waiting;
        waiting = new ArrayList<>();
        return taken;
    }

    synchronized boolean isEmpty() {
        return waiting.isEmpty();
    }

    /** Discards the waiting calls and all later ones. */
    synchronized void close() {
        isClosed = true;
        waiting.clear();
    }
}
