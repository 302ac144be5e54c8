package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;

/**
 * Remembers what another finder found last, so that the orientation goes where the General Message
 * link was found, without asking again.
 */
public final class KnownPlace implements PlaceFinder {
    private final PlaceFinder finder;
    private Place place;

    /** Makes a finder that asks {@code finder} and knows nothing yet. */
    public KnownPlace(PlaceFinder finder) {
        this.finder = finder;
    }

    /** Returns the place found last; null: none yet. */
    public Place place() {
        return place;
    }

    /** Forgets the place. */
    public void forget() {
        place = null;
    }

    /** Asks the other finder and remembers its answer. */
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
        return new PlaceFinder() {
            @Override
            public Cancellable find(FindListener listener) {
                if (place == null) {
                    listener.onNotFound("the Raspberry Pi is not found yet");
                } else {
                    listener.onFound(place);
                }
                return Search.DONE;
            }
        };
    }
}
