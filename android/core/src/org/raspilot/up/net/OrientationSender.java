package org.raspilot.up.net;

import java.util.Random;
import org.raspilot.up.loop.Loop;

/**
 * Sends orientation frames (protocols 3) over TCP or UDP; a frame that waits is replaced by the
 * next. Only on the loop.
 */
public final class OrientationSender {
    /** How frames travel. */
    public enum Transport {
        /** A connection that is kept. */
        TCP,
        /** One frame a datagram. */
        UDP
    }

    /**
     * Makes a sender that is not started.
     *
     * @param known where the General Message link was found; frames go to its orientation port
     * @param random seeded: the waits between attempts vary by it
     */
    public OrientationSender(Loop loop, KnownPlace known, Transport transport, Random random) {
    }

    /** Begins to connect, or opens the socket. */
    public void start() {
    }

    /** Closes. */
    public void stop() {
    }

    /** Tries to connect at once instead of after the wait; on UDP opens the socket anew. */
    public void reconnectNow() {
    }

    /**
     * Sends a frame of 24 bytes.
     *
     * @return false when it was dropped: not connected, or the place is not known
     * @throws IllegalArgumentException when it has another size
     */
    public boolean send(byte[] frame) {
        return false;
    }

    /** Returns whether frames can leave now. */
    public boolean isReady() {
        return false;
    }

    /** Returns a sentence without a full stop: whereto frames go, or why they do not. */
    public String sentence() {
        return "not started";
    }

    /** Returns how many frames the system took whole. */
    public long sent() {
        return 0;
    }

    /** Returns how many frames were dropped or replaced by a newer one. */
    public long dropped() {
        return 0;
    }
}
