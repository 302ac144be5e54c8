package org.raspilot.up.net;

/** Receives the result of a search for a peer. Called on the loop, one of the two, once. */
public interface DiscoveryListener {
    void onFound(Endpoint place);

    /**
     * Called when the search fails.
     *
     * @param reason a sentence without a full stop
     */
    void onNotFound(String reason);
}
