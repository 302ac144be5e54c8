package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;

/** A configured place: always found, immediately. */
public final class FixedPlace implements PlaceFinder {
    private final Place place;

    /** Creates a finder of {@code place}. */
    public FixedPlace(Place place) {
        this.place = place;
    }

    @Override
    public Cancellable find(FindListener listener) {
        listener.onFound(place);
        return Search.DONE;
    }
}
