package org.raspilot.up.ground;

/** How much an event or an alarm matters. */
public enum EventLevel {
    INFO,
    WARNING,
    ALARM
}
