package org.raspilot.up.net;

import java.util.Random;
import org.raspilot.up.loop.Loop;

/** Keeps one connection to a peer for ever. Only on the loop. */
public final class UpSocket {
    /**
     * Makes a socket that is not started.
     *
     * @param random seeded by whoever makes the socket: the waits vary by it
     */
    public UpSocket(Loop loop, PlaceFinder finder, UpSocketListener listener,
            UpSocketSettings settings, Random random) {
    }

    /** Begins to connect; started already, without effect. */
    public void start() {
    }

    /** Closes for good, or until {@link #start}: {@code onLost} is told when it was connected. */
    public void stop() {
    }

    /**
     * Tries at once instead of after the wait, as when the phone's network came back; connected, or
     * in the middle of an attempt, without effect.
     */
    public void reconnectNow() {
    }

    /** Ends this connection, or attempt, for {@code reason} and tries again after the wait. */
    public void drop(String reason) {
    }

    /**
     * Sends a line (its LF is added when it has none) or a frame, in order, and before what waits
     * for {@link #sendNewest}.
     *
     * @return false when not connected or when 64 KiB wait already: nothing is kept for later
     */
    public boolean send(byte[] bytes) {
        return false;
    }

    /**
     * Sends a line or a frame in place of the one that still waits under {@code key}.
     *
     * @return false when not connected: nothing is kept for later
     */
    public boolean sendNewest(Object key, byte[] bytes) {
        return false;
    }

    /** Returns whether a connection is there. */
    public boolean isConnected() {
        return false;
    }

    /** Returns how many bytes wait for the system to take them. */
    public int waitingBytes() {
        return 0;
    }

    /** Returns where the socket stands. */
    public UpSocketStatus status() {
        return new UpSocketStatus(UpSocketStatus.State.STOPPED, null, "not started");
    }

    /** Returns what was counted. */
    public UpSocketCounters counters() {
        return new UpSocketCounters(0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
    }
}
