package org.raspilot.up.ground;

import org.raspilot.up.wire.Seat;

/** The current state of the link; written by {@link GroundLink} and its {@link SeatClaim}. */
final class LinkFacts {
    LinkState state = LinkState.STOPPED;
    long sinceMs;
    String reason = "not started";
    String rejection = "";
    Seat seat;
    Integer holder;
    boolean isHolderKnown;
    /** The seat was left; the proxy has not confirmed it yet, but already drops our messages. */
    boolean isLeft;
    Integer askedBy;
    Boolean isAircraftOnline;
    Double roundTripMs;
    int failures;
    long connections;
    long malformed;
    long strangeControl;

    /** Clears the state that needs a connection. */
    void become(LinkState now, long nowMs, String why) {
        state = now;
        sinceMs = nowMs;
        reason = why;
        seat = null;
        holder = null;
        isHolderKnown = false;
        isLeft = false;
        askedBy = null;
        isAircraftOnline = null;
    }
}
