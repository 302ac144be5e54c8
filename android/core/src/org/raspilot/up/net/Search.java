package org.raspilot.up.net;

import org.raspilot.up.loop.Cancellable;

/** Searches that are over before they are returned. */
final class Search {
    static final Cancellable DONE = new Cancellable() {
        @Override
        public void cancel() {
        }

        @Override
        public boolean isPending() {
            return false;
        }
    };

    private Search() {
    }
}
