package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;

/** Finds the address of a peer; called before every attempt to connect. Only on the loop. */
public interface PlaceFinder {
    /**
     * Begins to look. The listener hears once, perhaps before this call returned, unless the search
     * is cancelled before.
     */
    Cancellable find(FindListener listener);
}
