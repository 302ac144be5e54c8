package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;

/** Finds the Raspberry Pi on the local network by Discovery (protocols 7). Only on the loop. */
public final class DiscoveryClient implements PlaceFinder {
    /** The UDP port of Discovery. */
    public static final int PORT = 3001;

    /**
     * Makes a client.
     *
     * @param addresses whom to ask
     * @param port Discovery's, {@link #PORT} unless configured
     * @param generalPort where the found host listens for General Messages
     * @param orientationPort where it listens for orientation; 0: nowhere
     */
    public DiscoveryClient(Loop loop, BroadcastAddresses addresses, int port, int generalPort,
            int orientationPort) {
    }

    @Override
    public Cancellable find(FindListener listener) {
        throw new UnsupportedOperationException();
    }

    /** Returns how many answers were not understood. */
    public long wrongAnswers() {
        return 0;
    }
}
