package org.raspilot.up.ground;

/** An event in plain words. Immutable. */
public final class Event {
    /** When it happened by the loop's clock, ms. */
    public final long atMs;
    public final EventLevel level;
    /** What happened, as a stable word: {@code armed link_lost receiver_lost ...}. */
    public final String code;
    /** What happened, safe to show, without a full stop. */
    public final String text;

    Event(long atMs, EventLevel level, String code, String text) {
        this.atMs = atMs;
        this.level = level;
        this.code = code;
        this.text = text;
    }
}
