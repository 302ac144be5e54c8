package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.net.EndpointDiscovery.DiscoveryListener;

/**
 * Stores the last result of another finder, so that orientation goes to the host of the General
 * Message link without another search.
 */
public final class LastEndpoint implements EndpointDiscovery {
    private final EndpointDiscovery discovery;
    private Endpoint endpoint;

    /** Creates a finder that delegates to {@code finder} and knows no place yet. */
    public LastEndpoint(EndpointDiscovery discovery) {
        this.discovery = discovery;
    }

    /** Returns the last place found; null: none so far. */
    public Endpoint endpoint() {
        return endpoint;
    }

    /** Searches with the other finder and stores its result. */
    @Override
    public Cancellable find(final DiscoveryListener listener) {
        return discovery.find(new DiscoveryListener() {
            @Override
            public void onFound(Endpoint found) {
                endpoint = found;
                listener.onFound(found);
            }

            @Override
            public void onNotFound(String code, String reason) {
                listener.onNotFound(code, reason);
            }
        });
    }

    /** Returns a finder without network traffic: it finds the stored place, or fails. */
    public EndpointDiscovery follower() {
        return listener -> {
            if (endpoint == null) {
                listener.onNotFound("not_found", "the Raspberry Pi is not found yet");
            } else {
                listener.onFound(endpoint);
            }
            return Cancellable.DONE;
        };
    }
}
