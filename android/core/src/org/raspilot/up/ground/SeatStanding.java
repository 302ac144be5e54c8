package org.raspilot.up.ground;

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
    LATER
}
