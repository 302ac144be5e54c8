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
    boolean isTls;
    /** Lines that the key does not authenticate, or that came before. */
    long refused;
    /** Plain lines on a link with a key, or protected ones without a key. */
    long unprotected;
    /** The name of this device's key: plain lines are refused; empty: it has none. */
    String keyName = "";
    /** The role of the key in the open session; empty without a session. */
    String keyRole = "";
    /** The code with which the aircraft refused the key; empty: it did not. */
    String keyRefusal = "";

    boolean isKeyed() {
        return !keyName.isEmpty();
    }

    /** Returns the code of what keeps the key's session closed; empty: it is open, or no key. */
    String keyFault() {
        if (!isKeyed() || !keyRole.isEmpty()) {
            return "";
        }
        return keyRefusal.isEmpty() ? "no_session" : keyRefusal;
    }

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
