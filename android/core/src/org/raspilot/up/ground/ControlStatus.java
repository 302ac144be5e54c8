package org.raspilot.up.ground;

import org.raspilot.up.ground.GroundStatus.LinkState;
import org.raspilot.up.wire.ProxyRole;

/** The state of the seat that commands. */
public enum ControlStatus {
    UNKNOWN,
    /** This ground commands; always so on a direct link, which has no seats. */
    OURS,
    /** The seat is free; a proxy may reserve it for its last owner for three seconds. */
    FREE,
    /** Another ground commands. */
    HELD,
    /** This ground listens and does not know the owner of control yet. */
    LATER;

    /** Returns the state of the seat; a direct link has no seats, so all may send there. */
    static ControlStatus of(LinkStatus facts, boolean isDirect) {
        if (facts.state != LinkState.OPEN) {
            return UNKNOWN;
        }
        if (isDirect || facts.role == ProxyRole.COMMAND && !facts.isReleased) {
            return OURS;
        }
        if (!facts.isOwnerKnown || facts.isReleased) {
            return LATER;
        }
        return facts.owner == null ? FREE : HELD;
    }
}
