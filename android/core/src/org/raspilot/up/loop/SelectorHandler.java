package org.raspilot.up.loop;

import java.nio.channels.SelectionKey;

/** What a selector's key belongs to. Called on the loop. */
interface SelectorHandler {
    void onReady(SelectionKey key);

    /** Takes the key that replaces its own: the selector was replaced. */
    void onMoved(SelectionKey key);

    void close();
}
