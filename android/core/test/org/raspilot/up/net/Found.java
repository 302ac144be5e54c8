package org.raspilot.up.net;

import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.net.EndpointDiscovery.DiscoveryListener;

/** Records the result of a finder. */
final class Found implements DiscoveryListener {
    final List<String> told = new ArrayList<>();
    final List<String> codes = new ArrayList<>();

    @Override
    public void onFound(Endpoint place) {
        told.add(place.toString());
    }

    @Override
    public void onNotFound(String code, String reason) {
        codes.add(code);
        told.add(reason);
    }
}
