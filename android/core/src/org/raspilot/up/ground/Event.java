package org.raspilot.up.ground;

/** An event in plain words. Immutable. */
public final class Event {
    private final long number;
    private final long atMs;
    private final EventLevel level;
    private final String kind;
    private final String text;

    Event(long number, long atMs, EventLevel level, String kind, String text) {
        this.number = number;
        this.atMs = atMs;
        this.level = level;
        this.kind = kind;
        this.text = text;
    }

    /** Returns its number, counting up from 1. */
    public long number() {
        return number;
    }

    /** Returns when it happened by the loop's clock, ms. */
    public long atMs() {
        return atMs;
    }

    /** Returns how much it matters. */
    public EventLevel level() {
        return level;
    }

    /**
     * Returns its kind: {@code mode armed failsafe panic link source veto battery command gains}.
     */
    public String kind() {
        return kind;
    }

    /** Returns what happened, safe to show, without a full stop. */
    public String text() {
        return text;
    }

    @Override
    public String toString() {
        return level + " " + text;
    }
}
