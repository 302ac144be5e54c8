package org.raspilot.up.ground;

import org.raspilot.up.wire.Seat;

/** How it stands with the seat that commands. */
public enum SeatStanding {
    /** There is no link. */
    UNKNOWN,
    /** This ground commands; always so on a direct link, which knows no seats. */
    OURS,
    /** Nobody commands; a proxy may keep the seat three seconds for who had it. */
    FREE,
    /** Another ground commands. */
    HELD,
    /** This ground listens and has not heard yet who commands. */
    LATER;

    /** Returns how it stands; a direct link knows no seats, so all may be sent there. */
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
