package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;

/** Finds the address of a peer; called before every attempt to connect. Only on the loop. */
public interface EndpointDiscovery {
    /**
     * Starts a search. The listener is called once, possibly before this call returns, unless the
     * search is cancelled before.
     */
    Cancellable find(DiscoveryListener listener);
}
