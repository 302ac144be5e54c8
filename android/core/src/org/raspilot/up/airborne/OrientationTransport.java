package org.raspilot.up.airborne;

/** How orientation leaves the phone. */
public enum OrientationTransport {
    /** Not at all. */
    OFF,
    /** Frames back to back on a connection. */
    TCP,
    /** A frame a datagram. */
    UDP
}
