package org.raspilot.up.net;

/** The state of an {@link UpSocket}: its activity, its place, why it is not connected. */
public final class UpSocketStatus {
    /** What a socket does. */
    public enum State {
        /** It was not started, or it was stopped. */
        STOPPED,
        /** Its finder is searching. */
        FINDING,
        /** It connects. */
        CONNECTING,
        /** It is connected. */
        CONNECTED,
        /** It waits before it tries again. */
        WAITING
    }

    private final State state;
    private final Place place;
    private final String sentence;

    UpSocketStatus(State state, Place place, String sentence) {
        this.state = state;
        this.place = place;
        this.sentence = sentence;
    }

    /** Returns what it does. */
    public State state() {
        return state;
    }

    /** Returns whether it is connected. */
    public boolean isConnected() {
        return state == State.CONNECTED;
    }

    /** Returns the last place found; null: none so far. */
    public Place place() {
        return place;
    }

    /** Returns a sentence without a full stop: the peer's address, or why it is not connected. */
    public String sentence() {
        return sentence;
    }

    @Override
    public String toString() {
        return state + ": " + sentence;
    }
}
