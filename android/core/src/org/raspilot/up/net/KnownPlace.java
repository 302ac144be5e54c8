package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;

/**
 * Stores the last result of another finder, so that orientation goes to the host of the General
 * Message link without another search.
 */
public final class KnownPlace implements PlaceFinder {
    private final PlaceFinder finder;
    private Place place;

    /** Creates a finder that delegates to {@code finder} and knows no place yet. */
    public KnownPlace(PlaceFinder finder) {
        this.finder = finder;
    }

    /** Returns the last place found; null: none so far. */
    public Place place() {
        return place;
    }

    public void forget() {
        place = null;
    }

    /** Searches with the other finder and stores its result. */
    @Override
    public Cancellable find(final FindListener listener) {
        return finder.find(new FindListener() {
            @Override
            public void onFound(Place found) {
                place = found;
                listener.onFound(found);
            }

            @Override
            public void onNotFound(String reason) {
                listener.onNotFound(reason);
            }
        });
    }

    /** Returns a finder without network traffic: it finds the stored place, or fails. */
    public PlaceFinder follower() {
        return listener -> {
            if (place == null) {
                listener.onNotFound("the Raspberry Pi is not found yet");
            } else {
                listener.onFound(place);
            }
            return Search.DONE;
        };
    }
}
