package org.raspilot.app;

import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

/** The events since the application started, the newest last, bounded. On the main thread. */
public final class AppLog {
    public static final int MAX_ENTRIES = 500;

    public interface Watcher {
        void onEvents();
    }

    public static final class Entry {
        /** When it happened last, ms since 1970. */
        public final long timeMs;
        public final String text;
        public final int times;

        Entry(long timeMs, String text, int times) {
            this.timeMs = timeMs;
            this.text = text;
            this.times = times;
        }
    }

    private final List<Entry> entries = new ArrayList<>();
    private final List<Watcher> watchers = new ArrayList<>();

    /** Writes a line; the same one again in a row is counted. */
    public void add(long timeMs, String text) {
        int last = entries.size() - 1;
        if (last >= 0 && entries.get(last).text.equals(text)) {
            entries.set(last, new Entry(timeMs, text, entries.get(last).times + 1));
        } else {
            entries.add(new Entry(timeMs, text, 1));
        }
        if (entries.size() > MAX_ENTRIES) {
            entries.remove(0);
        }
        notifyWatchers();
    }

    public void clear() {
        entries.clear();
        notifyWatchers();
    }

    /** Returns the lines, from the oldest to the newest. */
    public List<Entry> entries() {
        return Collections.unmodifiableList(new ArrayList<>(entries));
    }

    /** Returns the newest line, or null if absent. */
    public Entry newest() {
        return entries.isEmpty() ? null : entries.get(entries.size() - 1);
    }

    public void addWatcher(Watcher watcher) {
        if (!watchers.contains(watcher)) {
            watchers.add(watcher);
        }
    }

    public void removeWatcher(Watcher watcher) {
        watchers.remove(watcher);
    }

    private void notifyWatchers() {
        for (Watcher watcher : new ArrayList<>(watchers)) {
            watcher.onEvents();
        }
    }
}
