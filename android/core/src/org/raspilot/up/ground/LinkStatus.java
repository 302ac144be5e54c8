package org.raspilot.up.ground;

import org.raspilot.up.ground.GroundStatus.LinkState;
import org.raspilot.up.wire.ProxyRole;

/** The current state of the link; written by {@link GroundLink} and its {@link ControlLease}. */
final class LinkStatus {
    LinkState state = LinkState.STOPPED;
    long sinceMs;
    String code = "stopped";
    String reason = "not started";
    String rejection = "";
    ProxyRole role;
    Integer owner;
    boolean isOwnerKnown;
    /** The seat was left; the proxy has not confirmed it yet, but already drops our messages. */
    boolean isReleased;
    Integer requestedBy;
    Boolean isAircraftOnline;
    Double roundTripMs;
    int failures;
    long connections;
    long malformed;
    long strangeControl;

    /** Clears the state that needs a connection. */
    void enter(LinkState now, long nowMs, String whyCode, String why) {
        state = now;
        sinceMs = nowMs;
        code = whyCode;
        reason = why;
        role = null;
        owner = null;
        isOwnerKnown = false;
        isReleased = false;
        requestedBy = null;
        isAircraftOnline = null;
    }
}
