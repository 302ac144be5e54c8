package org.raspilot.up.ground;

import java.util.Locale;
import java.util.Map;

/** The outcome of a Command. Immutable; each sent Command has exactly one. */
public final class Answer {
    public enum Outcome {
        /** The aircraft carried it out. */
        ACK,
        /** The aircraft refused it. */
        NACK,
        /** Sent, and not answered in time or before the link was lost: it may have been executed. */
        TIMEOUT,
        /** It was not sent. */
        REFUSED;

        /** Returns the code of schema/commands.yml. */
        String code() {
            return this == REFUSED ? "unsent" : name().toLowerCase(Locale.ROOT);
        }

        /** Returns what happened, without a full stop. */
        String text() {
            return TelemetrySchema.OUTCOMES.get(code());
        }
    }

    public final Outcome outcome;
    public final String name;
    /**
     * The aircraft's code of a NACK (docs/protocols.md 4), for REFUSED one of {@code
     * no_link no_aircraft no_control no_beacon stale invalid busy}, for TIMEOUT {@code no_answer}
     * or {@code link_lost}, otherwise an empty text.
     */
    public final String code;
    /** The reason, safe to display, or an empty text. */
    public final String reason;
    /** The time from sending to the answer, ms; null: there was none. */
    public final Long roundTripMs;
    /** The requested data (gains, profile), unmodifiable, or null. */
    public final Map<String, Object> data;

    Answer(Outcome outcome, String name, String code, String reason, Long roundTripMs,
            Map<String, Object> data) {
        this.outcome = outcome;
        this.name = name;
        this.code = code;
        this.reason = reason;
        this.roundTripMs = roundTripMs;
        this.data = data;
    }

    /** Returns the answer to a Command that was not sent; {@code code} as in {@link #code}. */
    public static Answer refused(String name, String code, String reason) {
        return new Answer(Outcome.REFUSED, name, code, reason, null, null);
    }

    public boolean isAck() {
        return outcome == Outcome.ACK;
    }

    /** Returns the reason, or its code where it has none; possibly an empty text. */
    public String why() {
        return reason.isEmpty() ? code : reason;
    }

    /** Returns a sentence for the pilot, without a full stop. */
    public String sentence() {
        final String done = name + ": " + outcome.text();
        final String after = roundTripMs == null || !isAck() ? done
                : String.format(Locale.ROOT, "%s after %d ms", done, roundTripMs);
        return why().isEmpty() ? after : after + ": " + why();
    }

    /** Receives the outcome of a Command: once, on the loop, possibly before the call returns. */
    public interface AnswerListener {
        void onAnswer(Answer answer);
    }
}
