package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.net.EndpointDiscovery.DiscoveryListener;

/** A configured place: always found, immediately. */
public final class FixedEndpoint implements EndpointDiscovery {
    private final Endpoint place;

    /** Creates a finder of {@code place}. */
    public FixedEndpoint(Endpoint place) {
        this.place = place;
    }

    @Override
    public Cancellable find(DiscoveryListener listener) {
        listener.onFound(place);
        return Cancellable.DONE;
    }
}
