package org.raspilot.up.airborne;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;

/**
 * Detects a dead connection that neither side closed, for example after a gap in radio coverage.
 *
 * <p>After one second without a received line, the next message carries an id, which requests an
 * answer. If no answer comes within two seconds, the connection is closed. A peer that has not
 * answered any id on this connection, such as an old one, is exempt.
 */
final class LinkWatchdog {
    /** An answer is requested after this time without a received line, ms. */
    static final long QUIET_MS = 1000;
    /** Timeout of an answer, ms. */
    static final long ANSWER_MS = 2000;

    private final Loop loop;
    private final Runnable onDead;
    private final String prefix;
    private Cancellable timer = Cancellable.DONE;
    private long asked;
    private long receivedAtMs;
    private boolean isOpen;
    private boolean isAsking;
    private boolean isFirst;
    private boolean isAnswering;

    /**
     * Creates a watch; the ids begin with {@code prefix}, up to 8 hexadecimal digits and a dot
     * (protocols 4).
     */
    LinkWatchdog(Loop loop, String prefix, Runnable onDead) {
        this.loop = loop;
        this.prefix = prefix;
        this.onDead = onDead;
    }

    void opened() {
        closed();
        isOpen = true;
        isFirst = true;
        isAnswering = false;
        receivedAtMs = loop.nowMs();
    }

    void closed() {
        isOpen = false;
        settle();
    }

    void onLine() {
        receivedAtMs = loop.nowMs();
        settle();
    }

    void onAnswer(String id) {
        isAnswering |= isOpen && id.startsWith(prefix);
    }

    /** Returns the id that the next message is to carry, or null. */
    String nextId() {
        boolean isQuiet = loop.nowMs() - receivedAtMs >= QUIET_MS;
        if (!isOpen || isAsking || !(isFirst || isQuiet)) {
            return null;
        }
        isFirst = false;
        isAsking = true;
        if (isAnswering) {
            timer = loop.schedule(ANSWER_MS, onDead);
        }
        asked++;
        return prefix + asked;
    }

    private void settle() {
        isAsking = false;
        timer.cancel();
    }
}
