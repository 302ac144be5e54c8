package org.raspilot.app.commands;

import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedList;
import java.util.List;
import org.raspilot.up.ground.Answer;

/** The sent Commands with their answers, newest first. Main thread only. */
final class CommandHistory {
    static final int MAX_ENTRIES = 50;

    static final class Entry {
        final String words;
        /** When, by a monotonic clock, ms. */
        final long atMs;
        /** Null while it is waited for. */
        Answer answer;

        private Entry(String words, long atMs) {
            this.words = words;
            this.atMs = atMs;
        }
    }

    private final LinkedList<Entry> entries = new LinkedList<>();

    /** Adds a sent Command; its answer is set later. */
    Entry sent(String words, long nowMs) {
        Entry entry = new Entry(words, nowMs);
        entries.addFirst(entry);
        if (entries.size() > MAX_ENTRIES) {
            entries.removeLast();
        }
        return entry;
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
