package org.raspilot.up.providers;

/** What the screen shows of one provider: a snapshot that never changes. */
public final class ProviderStatus {
    public final String name;
    public final String sensor;
    public final ProviderState state;
    /** How many of its messages left in the last second, Hz. */
    public final double rateHz;
    /** The age of its newest reading, ms; -1: none so far. */
    public final long ageMs;
    /** What it sent last, as text; empty: nothing. */
    public final String lastText;
    /** The problem in one sentence, or an empty text. */
    public final String problem;

    ProviderStatus(String name, String sensor, ProviderState state, double rateHz, long ageMs,
            String lastText, String problem) {
        this.name = name;
        this.sensor = sensor;
        this.state = state;
        this.rateHz = rateHz;
        this.ageMs = ageMs;
        this.lastText = lastText;
        this.problem = problem;
    }

    public enum ProviderState {
        /** This device has no such sensor. */
        ABSENT,
        /** It was not started, or it was stopped. */
        STOPPED,
        /** No reading yet, or no link to send it on. */
        WAITING,
        SENDING,
        /** The sensor is present and has been silent for longer than allowed. */
        SILENT
    }
}
