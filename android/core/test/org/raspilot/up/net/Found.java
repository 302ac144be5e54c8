package org.raspilot.up.net;

import java.util.ArrayList;
import java.util.List;

/** Records the result of a finder. */
final class Found implements FindListener {
    final List<String> told = new ArrayList<>();

    @Override
    public void onFound(Place place) {
        told.add(place.toString());
    }

    @Override
    public void onNotFound(String reason) {
        told.add(reason);
    }
}
