package org.raspilot.up.ground;

/** An event in plain words. Immutable. */
public final class Event {
    /** Its number, counting up from 1. */
    public final long number;
    /** When it happened by the loop's clock, ms. */
    public final long atMs;
    public final EventLevel level;
    /**
     * Its kind: {@code mode armed failsafe panic link source veto battery command gains}.
     */
    public final String kind;
    /** What happened, safe to show, without a full stop. */
    public final String text;

    Event(long number, long atMs, EventLevel level, String kind, String text) {
        this.number = number;
        this.atMs = atMs;
        this.level = level;
        this.kind = kind;
        this.text = text;
    }

    @Override
    public String toString() {
        return level + " " + text;
    }
}
