package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import org.raspilot.up.commands.GainSet;

/** Asks for the gains, knows what flies now, sets them whole and undoes it. Only on the loop. */
public final class GainsDesk {
    /** So many sets are remembered. */
    public static final int KEPT = 50;

    /** The gains of a moment. Immutable. */
    public static final class Snapshot {
        private final long version;
        private final GainSet flying;
        private final Long toldMs;
        private final GainSet undo;
        private final List<GainsEntry> history;

        Snapshot(long version, GainSet flying, Long toldMs, GainSet undo,
                List<GainsEntry> history) {
            this.version = version;
            this.flying = flying;
            this.toldMs = toldMs;
            this.undo = undo;
            this.history = history;
        }

        /** Returns a number that rises with each change. */
        public long version() {
            return version;
        }

        /** Returns what the aircraft said last that flies; null: it has not said, or is asked. */
        public GainSet flying() {
            return flying;
        }

        /** Returns when it said so, by the loop's clock, ms; null: never. */
        public Long toldMs() {
            return toldMs;
        }

        /** Returns what {@link GainsDesk#undo} would set; null: there is nothing to undo. */
        public GainSet undo() {
            return undo;
        }

        /** Returns the sets that were sent, from the oldest to the newest, unmodifiable. */
        public List<GainsEntry> history() {
            return history;
        }
    }

    private Snapshot snapshot = new Snapshot(0, null, null, null,
            Collections.<GainsEntry>emptyList());

    GainsDesk() {
    }

    /** Returns the gains of now. */
    public Snapshot snapshot() {
        return snapshot;
    }

    /** Asks the aircraft which gains fly; the answer's data are they. */
    public void ask(AnswerListener listener) {
        listener.onAnswer(Answer.refused("arduino.pids.tunings", "no_link", "there is no link"));
    }

    /**
     * Sets the gains; a set that is not whole or out of 0 to 50 is refused here.
     *
     * @param shownBeacon the beacon of the frame that the screen shows; null: none
     */
    public void set(GainSet gains, Long shownBeacon, AnswerListener listener) {
        ask(listener);
    }

    /** Sets what flew before the newest set that was carried out and not yet undone. */
    public void undo(Long shownBeacon, AnswerListener listener) {
        ask(listener);
    }

    /** Returns the gains of {@code form} that differ from those of {@code flying} (or null). */
    public static List<GainChange> difference(GainSet flying, GainSet form) {
        return Collections.unmodifiableList(new ArrayList<GainChange>());
    }
}
