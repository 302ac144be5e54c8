package org.raspilot.up.ground;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import org.raspilot.up.wire.SafeText;

/** The newest events, the oldest of them going when there are too many. Only on the loop. */
public final class EventLog {
    public static final int MAX_ENTRIES = 200;

    private static final int MAX_TEXT_LENGTH = 400;

    /** A snapshot of the events. Immutable. */
    public static final class Snapshot {
        public final long version;
        /** The events from the oldest to the newest, unmodifiable. */
        public final List<Event> events;

        Snapshot(long version, List<Event> events) {
            this.version = version;
            this.events = events;
        }
    }

    private final ArrayDeque<Event> events = new ArrayDeque<>();
    private long number;
    private Snapshot snapshot = new Snapshot(0, Collections.emptyList());

    /** Adds an event; {@code code} as in {@link Event#code}. */
    public void add(long atMs, EventLevel level, String code, String text) {
        number++;
        events.add(new Event(atMs, level, code, SafeText.of(text, MAX_TEXT_LENGTH)));
        if (events.size() > MAX_ENTRIES) {
            events.remove();
        }
    }

    /** Returns the number of the newest event, 0 before the first. */
    public long version() {
        return number;
    }

    public Snapshot snapshot() {
        if (snapshot.version != number) {
            snapshot = new Snapshot(number,
                    Collections.unmodifiableList(new ArrayList<>(events)));
        }
        return snapshot;
    }
}
