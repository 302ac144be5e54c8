package org.raspilot.up.commands;

import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.Json;

/**
 * The ids of one link and their answers: the newest 256 of the last 60 s.
 *
 * <p>The same id with another name or other data is another Command, because old peers reuse one id
 * for all Commands. Source: docs/protocols.md 4.
 */
final class AnswerCache {
    static final int MAX_ENTRIES = 256;
    static final long MAX_AGE_MS = 60000;

    private final Map<String, Entry> entries = new LinkedHashMap<>();

    /** Stores a message with an id; returns the known entry if the message is a repetition. */
    Entry add(GeneralMessage message, long nowMs) {
        discardExpired(nowMs);
        String content = message.name + " " + Json.write(message.data);
        Entry known = entries.get(message.id);
        if (known != null && known.content.equals(content)) {
            return known;
        }
        entries.remove(message.id);
        Iterator<Entry> oldest = entries.values().iterator();
        while (entries.size() >= MAX_ENTRIES) {
            oldest.next();
            oldest.remove();
        }
        entries.put(message.id, new Entry(content, nowMs));
        return null;
    }

    void setAnswer(String id, GeneralMessage answer) {
        Entry entry = entries.get(id);
        if (entry != null) {
            entry.answer = answer;
        }
    }

    private void discardExpired(long nowMs) {
        Iterator<Entry> oldest = entries.values().iterator();
        while (oldest.hasNext() && oldest.next().timeMs < nowMs - MAX_AGE_MS) {
            oldest.remove();
        }
    }

    static final class Entry {
        private final String content;
        private final long timeMs;
        /** Null until there is one. */
        GeneralMessage answer;

        private Entry(String content, long timeMs) {
            this.content = content;
            this.timeMs = timeMs;
        }
    }
}
