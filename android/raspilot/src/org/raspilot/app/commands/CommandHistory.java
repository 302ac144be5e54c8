package org.raspilot.app.commands;

import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedList;
import java.util.List;

/** The sent Commands with their outcomes, newest first. Main thread only. */
final class CommandHistory {
    static final int MAX_ENTRIES = 50;

    enum Outcome {
        /** The answer is waited for. */
        WAITING,
        /** It was carried out. */
        GOOD,
        /** The aircraft refused it. */
        REFUSED,
        /** It was not sent. */
        UNSENT,
        /** It may or may not have been executed. */
        UNKNOWN
    }

    /** One Command that was sent. Immutable. */
    static final class Entry {
        /** Counts up from 1. */
        final int number;
        final String words;
        /** When, by a monotonic clock, ms. */
        final long atMs;
        final Outcome outcome;
        /** The reason, without a full stop, or an empty text. */
        final String reason;
        /** Time until the answer, ms; null if there was none or it is unknown. */
        final Long roundTripMs;

        private Entry(int number, String words, long atMs, Outcome outcome, String reason,
                Long roundTripMs) {
            this.number = number;
            this.words = words;
            this.atMs = atMs;
            this.outcome = outcome;
            this.reason = reason;
            this.roundTripMs = roundTripMs;
        }
    }

    private final LinkedList<Entry> entries = new LinkedList<>();
    private int numbers;

    /** Adds a sent Command; returns the number to report its outcome with. */
    int sent(String words, long nowMs) {
        numbers++;
        entries.addFirst(new Entry(numbers, words, nowMs, Outcome.WAITING, "", null));
        if (entries.size() > MAX_ENTRIES) {
            entries.removeLast();
        }
        return numbers;
    }

    /** Sets the outcome of an entry; ignored if the entry was dropped. */
    void answered(int number, Outcome outcome, String reason, Long roundTripMs) {
        for (int place = 0; place < entries.size(); place++) {
            Entry entry = entries.get(place);
            if (entry.number == number) {
                entries.set(place, new Entry(number, entry.words, entry.atMs, outcome, reason,
                        roundTripMs));
            }
        }
    }

    /** Returns all, the newest first; a copy. */
    List<Entry> entries() {
        return Collections.unmodifiableList(new ArrayList<>(entries));
    }

    /** Returns the newest; null: nothing was sent. */
    Entry newest() {
        return entries.peekFirst();
    }
}
