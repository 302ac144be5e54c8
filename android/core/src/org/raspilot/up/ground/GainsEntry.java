package org.raspilot.up.ground;

import java.util.List;
import org.raspilot.up.commands.GainSet;

/** One set of gains that was sent, and its outcome. Immutable. */
public final class GainsEntry {
    /** Its number, counting up from 1. */
    public final int number;
    /** When its answer came, by the loop's clock, ms. */
    public final long atMs;
    /** What flew before; null: not known. */
    public final GainSet before;
    public final GainSet after;
    public final Answer answer;

    GainsEntry(int number, long atMs, GainSet before, GainSet after, Answer answer) {
        this.number = number;
        this.atMs = atMs;
        this.before = before;
        this.after = after;
        this.answer = answer;
    }

    /** Returns the gains in which the two differ. */
    public List<GainChange> changes() {
        return GainsService.difference(before, after);
    }
}
