package org.raspilot.up.providers;

/** What the screen shows of one provider: a snapshot that never changes. */
public final class ProviderStatus {
    private final String name;
    private final String sensor;
    private final ProviderState state;
    private final double rateHz;
    private final long ageMs;
    private final String lastText;
    private final String problem;
    private final long sent;

    /** Stores the values. */
    public ProviderStatus(
            String name,
            String sensor,
            ProviderState state,
            double rateHz,
            long ageMs,
            String lastText,
            String problem,
            long sent) {
        this.name = name;
        this.sensor = sensor;
        this.state = state;
        this.rateHz = rateHz;
        this.ageMs = ageMs;
        this.lastText = lastText;
        this.problem = problem;
        this.sent = sent;
    }

    /** Returns the provider's name. */
    public String name() {
        return name;
    }

    /** Returns what the sensor calls itself. */
    public String sensor() {
        return sensor;
    }

    /** Returns what it does now. */
    public ProviderState state() {
        return state;
    }

    /** Returns how many of its messages left in the last second, Hz. */
    public double rateHz() {
        return rateHz;
    }

    /** Returns the age of its newest reading, ms; -1: none so far. */
    public long ageMs() {
        return ageMs;
    }

    /** Returns what it sent last, as text; empty: nothing. */
    public String lastText() {
        return lastText;
    }

    /** Returns the problem in one sentence, or an empty text. */
    public String problem() {
        return problem;
    }

    /** Returns how many messages left since it was registered. */
    public long sent() {
        return sent;
    }
}
