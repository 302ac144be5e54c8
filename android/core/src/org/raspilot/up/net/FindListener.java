package org.raspilot.up.net;

/** Hears where a peer listens. Called on the loop, one of the two, once. */
public interface FindListener {
    /** Takes the place. */
    void onFound(Place place);

    /**
     * Called when the search fails.
     *
     * @param reason a sentence without a full stop
     */
    void onNotFound(String reason);
}
