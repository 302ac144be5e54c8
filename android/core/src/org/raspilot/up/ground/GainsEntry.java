package org.raspilot.up.ground;

import java.util.List;
import org.raspilot.up.commands.GainSet;

/** One set of gains that was sent, and its outcome. Immutable. */
public final class GainsEntry {
    private final int number;
    private final long atMs;
    private final GainSet before;
    private final GainSet after;
    private final Answer answer;

    GainsEntry(int number, long atMs, GainSet before, GainSet after, Answer answer) {
        this.number = number;
        this.atMs = atMs;
        this.before = before;
        this.after = after;
        this.answer = answer;
    }

    /** Returns its number, counting up from 1. */
    public int number() {
        return number;
    }

    /** Returns when its answer came, by the loop's clock, ms. */
    public long atMs() {
        return atMs;
    }

    /** Returns what flew before; null: not known. */
    public GainSet before() {
        return before;
    }

    /** Returns the set that was sent. */
    public GainSet after() {
        return after;
    }

    /** Returns the outcome. */
    public Answer answer() {
        return answer;
    }

    /** Returns the gains in which the two differ. */
    public List<GainChange> changes() {
        return GainsDesk.difference(before, after);
    }
}
