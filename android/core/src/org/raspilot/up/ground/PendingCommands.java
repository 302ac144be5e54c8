package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Collections;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Locale;
import java.util.Map;
import java.util.Random;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.ground.Answer.AnswerListener;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.SafeText;

/** Sent Commands: each ends once, regardless of duplicate, late or foreign answers. */
final class PendingCommands {
    /** Timeout of an answer, ms; a later answer is ignored. */
    static final long LIMIT_MS = 3000;
    static final int MAX_WAITING = 32;

    private static final int MAX_REASON_LENGTH = 500;
    /** The message with the requested data, by the name of the request. */
    private static final Map<String, String> CONTENT_OF = new HashMap<>();

    static {
        CONTENT_OF.put("arduino.pids.tunings", "arduino.pids.values");
        CONTENT_OF.put("arduino.profile.request", "arduino.profile.values");
    }

    private final class Sent implements Runnable {
        final String id;
        final String name;
        final AnswerListener listener;
        final long sentMs = loop.nowMs();
        final Cancellable timer = loop.schedule(LIMIT_MS, this);
        String awaited;
        Map<String, Object> data;
        Long ackedMs;

        Sent(String id, String name, String awaited, AnswerListener listener) {
            this.id = id;
            this.name = name;
            this.awaited = awaited;
            this.listener = listener;
        }

        @Override
        public void run() {
            endUnanswered(this, "no_answer", "no answer within " + LIMIT_MS / 1000 + " s");
        }
    }

    private final Loop loop;
    private final Random random;
    private final Map<String, Sent> sent = new LinkedHashMap<>();
    private long number;

    PendingCommands(Loop loop, Random random) {
        this.loop = loop;
        this.random = random;
    }

    int waiting() {
        return sent.size();
    }

    /** Returns the id to send a Command with; the listener receives its outcome. */
    String add(BaseCommand command, AnswerListener listener) {
        // Grounds share the aircraft's link, so a plain number would not be unique.
        final String id = String.format(Locale.ROOT, "%016x-%d", random.nextLong(), ++number);
        final boolean asks = isRequest(command);
        final String awaited = asks ? CONTENT_OF.get(command.name()) : null;
        sent.put(id, new Sent(id, command.name(), awaited, listener));
        return id;
    }

    /** Returns whether a Command is only a request, which every observer may send. */
    static boolean isRequest(BaseCommand command) {
        return CONTENT_OF.containsKey(command.name())
                && (!command.name().equals("arduino.pids.tunings")
                || Boolean.TRUE.equals(command.data().get("request")));
    }

    /** Discards a Command that could not be sent after all; its listener is not called. */
    void remove(String id) {
        final Sent gone = sent.remove(id);
        if (gone != null) {
            gone.timer.cancel();
        }
    }

    /** Takes a Command of the aircraft, if it is an answer. */
    void receive(GeneralMessage message) {
        final boolean isAck = message.name.equals(Commands.ACK);
        if (isAck || message.name.equals(Commands.NACK)) {
            final Object id = message.data.get("id");
            final Sent found = id instanceof String ? sent.get(id) : null;
            // Others are late, or those of other grounds.
            if (found != null) {
                onAnswer(found, isAck, message.data);
            }
            return;
        }
        for (Sent each : new ArrayList<>(sent.values())) {
            if (message.name.equals(each.awaited)) {
                each.awaited = null;
                each.data = Collections.unmodifiableMap(message.data);
                if (each.ackedMs != null) {
                    end(each, Answer.Outcome.ACK, "", "", each.ackedMs);
                }
            }
        }
    }

    /** Called when the link is lost: sent Commands may or may not have arrived. */
    void onLost() {
        for (Sent each : new ArrayList<>(sent.values())) {
            endUnanswered(each, "link_lost", "the link was lost before an answer came");
        }
    }

    private void onAnswer(Sent found, boolean isAck, Map<String, Object> data) {
        final long tookMs = loop.nowMs() - found.sentMs;
        if (!isAck) {
            end(found, Answer.Outcome.NACK, text(data, "code"), text(data, "reason"), tookMs);
        } else if (found.awaited != null) {
            found.ackedMs = tookMs;
        } else {
            end(found, Answer.Outcome.ACK, "", "", tookMs);
        }
    }

    private void endUnanswered(Sent each, String code, String why) {
        if (each.ackedMs != null) {
            end(each, Answer.Outcome.ACK, "", "the requested data did not arrive", each.ackedMs);
        } else {
            end(each, Answer.Outcome.TIMEOUT, code, why, null);
        }
    }

    private void end(Sent each, Answer.Outcome outcome, String code, String reason,
            Long tookMs) {
        if (sent.remove(each.id) != null) {
            each.timer.cancel();
            each.listener.onAnswer(
                    new Answer(outcome, each.name, code, reason, tookMs, each.data));
        }
    }

    private static String text(Map<String, Object> data, String key) {
        final Object found = data.get(key);
        return found instanceof String ? SafeText.of((String) found, MAX_REASON_LENGTH) : "";
    }
}
