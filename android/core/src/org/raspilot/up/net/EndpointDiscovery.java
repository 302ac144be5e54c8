package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;

/** Finds the address of a peer; called before every attempt to connect. Only on the loop. */
public interface EndpointDiscovery {
    /**
     * Starts a search. The listener is called once, possibly before this call returns, unless the
     * search is cancelled before.
     */
    Cancellable find(DiscoveryListener listener);

    /** Receives the result of a search for a peer. Called on the loop, one of the two, once. */
    interface DiscoveryListener {
        void onFound(Endpoint place);

        /**
         * Called when the search fails.
         *
         * @param reason a sentence without a full stop
         */
        void onNotFound(String reason);
    }
}
