package org.raspilot.up.ground;

/** How much an event or an alarm matters. */
public enum EventLevel {
    /** Good to know. */
    INFO,
    /** Needs attention. */
    WARNING,
    /** Requires immediate action. */
    ALARM
}
