package org.raspilot.up.ground;

/** How far the connection to the other side is. */
public enum LinkState {
    /** Not started, or stopped. */
    STOPPED,
    /** In progress: connecting, or waiting for the answer to the hello. */
    CONNECTING,
    /** Messages can go. */
    OPEN,
    /** Lost or refused: it is tried again after a little wait. */
    WAITING
}
