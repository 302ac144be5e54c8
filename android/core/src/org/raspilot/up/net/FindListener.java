package org.raspilot.up.net;

/** Receives the result of a search for a peer. Called on the loop, one of the two, once. */
public interface FindListener {
    void onFound(Place place);

    /**
     * Called when the search fails.
     *
     * @param reason a sentence without a full stop
     */
    void onNotFound(String reason);
}
