package org.raspilot.up.airborne;

/** Who the phone speaks to (thesis 3.1.3). */
public enum AirborneMode {
    /** A Raspberry Pi on board, with an Arduino that flies. */
    FLIGHT_CONTROLLER,
    /** A server on the internet that a runner spawns; the phone is the only one on board. */
    BLACK_BOX
}
