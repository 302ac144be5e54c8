package org.raspilot.up.ground;

/** Whether a value may be flown by. */
public enum Freshness {
    /** Present and not stale. */
    LIVE,
    /** It is there, but too old, or the link is silent: it is shown as old. */
    STALE,
    /** It is not known. */
    NONE
}
