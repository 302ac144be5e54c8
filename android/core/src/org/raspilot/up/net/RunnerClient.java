package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;

/** Asks a runner for an instance and finds where it listens (protocols 8). Only on the loop. */
public final class RunnerClient implements PlaceFinder {
    /** The TCP port of a runner. */
    public static final int PORT = 3002;

    /**
     * Makes a client.
     *
     * @param host the runner's name or address
     * @param port its port, {@link #PORT} unless configured
     */
    public RunnerClient(Loop loop, String host, int port, RunnerRequest request) {
    }

    @Override
    public Cancellable find(FindListener listener) {
        throw new UnsupportedOperationException();
    }

    /** Returns the newest answer that named a place; null: none yet. */
    public RunnerAnswer lastAnswer() {
        return null;
    }
}
