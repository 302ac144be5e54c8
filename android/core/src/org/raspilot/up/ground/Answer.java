package org.raspilot.up.ground;

import java.util.Locale;
import java.util.Map;

/** What became of a Command. Immutable; each Command that is sent has exactly one. */
public final class Answer {
    /** What became of it. */
    public enum Outcome {
        /** The aircraft carried it out. */
        ACK,
        /** The aircraft refused it. */
        NACK,
        /** It was sent and no answer came: nobody knows whether it was carried out. */
        TIMEOUT,
        /** It was sent and the link was lost before an answer: nobody knows either. */
        LOST,
        /** It was not sent. */
        REFUSED
    }

    private final Outcome outcome;
    private final String name;
    private final String code;
    private final String reason;
    private final Long roundTripMs;
    private final Map<String, Object> data;

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

    /** Returns what became of it. */
    public Outcome outcome() {
        return outcome;
    }

    /** Says whether the aircraft carried it out. */
    public boolean isAck() {
        return outcome == Outcome.ACK;
    }

    /** Returns which Command it was. */
    public String name() {
        return name;
    }

    /**
     * Returns the aircraft's code of a NACK (docs/protocols.md 4), of a REFUSED one of
     * {@code no_link no_aircraft no_seat no_beacon stale forbidden invalid busy}, else empty.
     */
    public String code() {
        return code;
    }

    /** Returns why, safe to show; empty where there is nothing to say. */
    public String reason() {
        return reason;
    }

    /** Returns the time from sending to the answer, ms; null: there was none. */
    public Long roundTripMs() {
        return roundTripMs;
    }

    /** Returns what was asked for besides the ack (gains, profile), unmodifiable, or null. */
    public Map<String, Object> data() {
        return data;
    }

    /** Returns a sentence for the pilot, without a full stop. */
    public String sentence() {
        switch (outcome) {
            case ACK:
                final String done = name + " carried out";
                final String after = roundTripMs == null ? done : String.format(Locale.ROOT,
                        "%s after %d ms", done, roundTripMs);
                return reason.isEmpty() ? after : after + ": " + reason;
            case NACK:
                return "the aircraft refused " + name + ": " + (reason.isEmpty() ? code : reason);
            case REFUSED:
                return name + " was not sent: " + reason;
            default:
                return name + ": " + reason;
        }
    }

    @Override
    public String toString() {
        return sentence();
    }
}
