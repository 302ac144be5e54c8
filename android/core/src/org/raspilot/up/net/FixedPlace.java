package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;

/** A place that is configured: found at once, always. */
public final class FixedPlace implements PlaceFinder {
    private final Place place;

    /** Makes a finder of {@code place}. */
    public FixedPlace(Place place) {
        this.place = place;
    }

    @Override
    public Cancellable find(FindListener listener) {
        listener.onFound(place);
        return Search.DONE;
    }
}
