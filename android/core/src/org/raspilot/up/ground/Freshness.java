package org.raspilot.up.ground;

/** Whether a value may be flown by. */
public enum Freshness {
    /** It is there and as young as it should be. */
    LIVE,
    /** It is there, but too old, or the link is silent: it is shown as old. */
    STALE,
    /** It is not known. */
    NONE
}
