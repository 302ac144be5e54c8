package org.raspilot.up.ground;

import org.raspilot.up.wire.Seat;

/** The state of the seat that commands. */
public enum SeatStanding {
    /** No link. */
    UNKNOWN,
    /** This ground commands; always so on a direct link, which has no seats. */
    OURS,
    /** The seat is free; a proxy may reserve it for its last owner for three seconds. */
    FREE,
    /** Another ground commands. */
    HELD,
    /** This ground listens and does not know yet who commands. */
    LATER;

    /** Returns the state of the seat; a direct link has no seats, so all may send there. */
    static SeatStanding of(LinkFacts facts, boolean isDirect) {
        if (facts.state != LinkState.OPEN) {
            return UNKNOWN;
        }
        if (isDirect || facts.seat == Seat.COMMAND && !facts.isLeft) {
            return OURS;
        }
        if (!facts.isHolderKnown || facts.isLeft) {
            return LATER;
        }
        return facts.holder == null ? FREE : HELD;
    }
}
