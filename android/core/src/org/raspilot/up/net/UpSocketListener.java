package org.raspilot.up.net;

/** Receives the data and events of an {@link UpSocket}. Called on the loop. */
public interface UpSocketListener {
    /** Called when a connection is open: a message sent now is the first on it. */
    default void onConnected() {
    }

    /**
     * Takes what arrived: in line mode the first {@code length} bytes of {@code bytes} are one line
     * that is not empty, without its end; in raw mode whatever came. The array may be reused
     * afterwards.
     */
    default void onReceived(byte[] bytes, int length) {
    }

    /**
     * Called when an open connection is lost; a new attempt follows unless the socket was stopped.
     */
    default void onLost(String reason) {
    }

    /** Called shortly after {@link UpSocket#status} has changed: for a screen. */
    default void onStatus() {
    }
}
