package org.raspilot.up.net;

/** The state of an {@link UpSocket}: its activity, its place, why it is not connected. */
public final class UpSocketStatus {
    public enum State {
        /** It was not started, or it was stopped. */
        STOPPED,
        FINDING,
        CONNECTING,
        CONNECTED,
        /** It waits before it tries again. */
        WAITING
    }

    public final State state;
    /** The last place found; null: none so far. */
    public final Endpoint endpoint;
    /**
     * Why it is not connected, as a stable word: {@code not_found closed stopped silent tls_...},
     * or a runner's; otherwise empty.
     */
    public final String code;

    /** A sentence without a full stop: the peer's address, or why it is not connected. */
    public final String sentence;

    UpSocketStatus(State state, Endpoint place, String code, String sentence) {
        this.state = state;
        this.endpoint = place;
        this.code = code;
        this.sentence = sentence;
    }

    public boolean isConnected() {
        return state == State.CONNECTED;
    }
}
