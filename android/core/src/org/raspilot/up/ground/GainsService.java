package org.raspilot.up.ground;

import java.math.BigDecimal;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;
import org.raspilot.up.ground.Answer.AnswerListener;
import org.raspilot.up.ground.GainsService.GainChange;
import org.raspilot.up.loop.Loop;

/** Requests, tracks, replaces and restores the active gains, as whole sets. On the loop only. */
public final class GainsService {
    /** Maximum number of sets that are kept and can be undone. */
    public static final int MAX_ENTRIES = 50;
    /** Receives the gains that the aircraft reports. */
    static final String VALUES = "arduino.pids.values";

    /** The board holds gains in single precision. */
    private static final double SINGLE = 1e-6;
    private static final double NEAR_ZERO = 1e-9;

    /** A snapshot of the gains. Immutable. */
    public static final class Snapshot {
        public final long version;
        /** The last gains that the aircraft reported; null: none so far. */
        public final GainSet flying;
        /** The time of that report, by the loop's clock, ms; null: none. */
        public final Long reportedMs;
        /** What {@link GainsService#undo} would set; null: there is nothing to undo. */
        public final GainSet undo;
        /** The sets that were sent, from the oldest to the newest, unmodifiable. */
        public final List<GainsEntry> history;

        Snapshot(long version, GainSet flying, Long reportedMs, GainSet undo,
                List<GainsEntry> history) {
            this.version = version;
            this.flying = flying;
            this.reportedMs = reportedMs;
            this.undo = undo;
            this.history = history;
        }
    }

    /** Sends a Command as {@link GroundSide#send} does. */
    interface Sender {
        void send(BaseCommand command, Long shownBeacon, AnswerListener listener);
    }

    private final Loop loop;
    private final Sender sender;
    private final ArrayDeque<GainsEntry> history = new ArrayDeque<>();
    private final ArrayDeque<GainSet> undoable = new ArrayDeque<>();
    private GainSet flying;
    private Long reportedMs;
    private int number;
    private boolean isDue = true;
    private long version;
    private Snapshot snapshot;

    GainsService(Loop loop, Sender sender) {
        this.loop = loop;
        this.sender = sender;
    }

    public long version() {
        return version;
    }

    public Snapshot snapshot() {
        if (snapshot == null || snapshot.version != version) {
            snapshot = new Snapshot(version, flying, reportedMs, undoable.peekLast(),
                    Collections.unmodifiableList(new ArrayList<>(history)));
        }
        return snapshot;
    }

    /** Requests the active gains from the aircraft; they are the answer's data. */
    public void request(AnswerListener listener) {
        isDue = false;
        sender.send(Commands.pidsRequest(), null, listener);
    }

    /**
     * Sets the gains, with the beacon of the frame on the screen; a set that is not whole or out of
     * 0 to 50 is refused here.
     */
    public void set(GainSet gains, Long shownBeacon, AnswerListener listener) {
        transmit(gains, shownBeacon, listener, false);
    }

    /** Restores the gains from before the newest set that was executed and not yet undone. */
    public void undo(Long shownBeacon, AnswerListener listener) {
        final GainSet before = undoable.peekLast();
        if (before == null) {
            listener.onAnswer(Answer.refused(Commands.PIDS, "invalid",
                    "no set of gains to undo"));
        } else {
            transmit(before, shownBeacon, listener, true);
        }
    }

    /** Returns the gains of {@code form} that differ from those of {@code flying} (or null). */
    public static List<GainChange> difference(GainSet flying, GainSet form) {
        final List<GainChange> changes = new ArrayList<>();
        for (GainKey key : GainKey.ALL) {
            final Double before = key.of(flying);
            final Double after = key.of(form);
            if (after != null && !isSame(before, after)) {
                changes.add(new GainChange(key, before, after));
            }
        }
        return Collections.unmodifiableList(changes);
    }

    /**
     * Returns the gains that a Command sets, or null if it sets none.
     *
     * @throws InvalidCommandException with one sentence when the set is incomplete
     */
    static GainSet gainsOf(BaseCommand command) {
        final Object pids = command.data().get("pids");
        if (!command.name().equals(Commands.PIDS) || PendingCommands.isRequest(command)) {
            return null;
        }
        if (!(pids instanceof Map)) {
            throw new InvalidCommandException("missing", "pids", "is missing");
        }
        @SuppressWarnings("unchecked")
        final Map<String, Object> data = (Map<String, Object>) pids;
        return GainSet.ofData(data);
    }

    /** Takes the aircraft's active gains; returns false if the value is not a set. */
    boolean receive(Map<String, Object> values) {
        try {
            flying = GainSet.ofData(values);
        } catch (InvalidCommandException fault) {
            return false;
        }
        reportedMs = loop.nowMs();
        version++;
        return true;
    }

    /** Called when the link is another one: the aircraft may use other gains. */
    void requestAgain() {
        isDue = true;
    }

    /** Requests the gains when due; called while Commands can be sent. */
    void onTick() {
        if (isDue) {
            request(answer -> {
                // One automatic request. Its result is reported; the pilot can request again.
            });
        }
    }

    private void transmit(final GainSet gains, Long shownBeacon, final AnswerListener listener,
            final boolean isUndo) {
        final BaseCommand command;
        try {
            command = Commands.pids(gains);
        } catch (InvalidCommandException fault) {
            listener.onAnswer(Answer.refused(Commands.PIDS, "invalid", fault.getMessage()));
            return;
        }
        final GainSet before = flying;
        sender.send(command, shownBeacon, answer -> {
            if (answer.outcome != Answer.Outcome.REFUSED) {
                record(before, gains, answer, isUndo);
            }
            listener.onAnswer(answer);
        });
    }

    private void record(GainSet before, GainSet after, Answer answer, boolean isUndo) {
        number++;
        history.add(new GainsEntry(number, before, after, answer));
        if (history.size() > MAX_ENTRIES) {
            history.remove();
        }
        if (answer.isAck()) {
            if (isUndo) {
                undoable.remove(after);
            } else if (before != null) {
                undoable.add(before);
            }
            if (undoable.size() > MAX_ENTRIES) {
                undoable.remove();
            }
        }
        // After a timeout the active gains are unknown until the aircraft reports them.
        isDue |= answer.outcome != Answer.Outcome.NACK;
        version++;
    }

    private static boolean isSame(Double before, double after) {
        return before != null && Math.abs(before - after)
                <= Math.max(NEAR_ZERO, SINGLE * Math.max(Math.abs(before), Math.abs(after)));
    }

    /** One gain that differs between two sets. Immutable. */
    public static final class GainChange {
        public final GainKey key;
        /** Its value before; null: not known. */
        public final Double before;
        public final double after;

        GainChange(GainKey key, Double before, double after) {
            this.key = key;
            this.before = before;
            this.after = after;
        }

        /** Returns {@code rate roll P 3 to 2.4}. */
        @Override
        public String toString() {
            final String from = before == null ? "" : number(before) + " to ";
            return key.words() + " " + from + number(after);
        }

        /** Returns a gain as the shortest text that is this number, without an exponent. */
        static String number(double value) {
            if (Double.isNaN(value) || Double.isInfinite(value)) {
                return String.valueOf(value);
            }
            // The board holds gains in single precision: 0.1f is not 0.10000000149.
            final boolean isSingle = (float) value == value;
            final String text = isSingle ? Float.toString((float) value) : Double.toString(value);
            final String plain = new BigDecimal(text).toPlainString();
            return plain.contains(".") ? plain.replaceFirst("\\.?0+$", "") : plain;
        }
    }

    /** One set of gains that was sent, and its outcome. Immutable. */
    public static final class GainsEntry {
        /** Its number, counting up from 1. */
        public final int number;
        /** What flew before; null: not known. */
        public final GainSet before;
        public final GainSet after;
        public final Answer answer;

        GainsEntry(int number, GainSet before, GainSet after, Answer answer) {
            this.number = number;
            this.before = before;
            this.after = after;
            this.answer = answer;
        }

        public List<GainChange> changes() {
            return GainsService.difference(before, after);
        }
    }
}
