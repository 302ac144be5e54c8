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
         * @param code why, as a stable word: {@code not_found}, or a runner's
         * @param reason a sentence without a full stop
         */
        void onNotFound(String code, String reason);
    }
}
