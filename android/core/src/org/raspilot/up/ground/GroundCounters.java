package org.raspilot.up.ground;

/** What a {@link GroundSide} counted since it was made. Immutable. */
public final class GroundCounters {
    /** How often the link became open. */
    public final long connections;
    /** How many frames of telemetry came. */
    public final long frames;
    /** How many frames were sent, by the beacons' numbers, and did not come. */
    public final long lostFrames;
    /** How many lines were no General Messages. */
    public final long malformed;
    /** How many lines were too long. */
    public final long tooLong;
    /** The number of unknown or unexpected lines of the proxy. */
    public final long strangeControl;
    /** How many packed frames had a key that was not received here. */
    public final long keyless;
    /** How many lines the key did not authenticate, or came before. */
    public final long refused;
    /** How many plain lines came on a link with a key, or protected ones without. */
    public final long unprotected;
    /** How many answers were of no Command that waits for one. */
    public final long strangeAnswers;

    GroundCounters(LinkStatus facts, TelemetryStream stream, long tooLong, long strangeAnswers) {
        connections = facts.connections;
        frames = stream.frames();
        lostFrames = stream.lost();
        malformed = facts.malformed;
        this.tooLong = tooLong;
        strangeControl = facts.strangeControl;
        keyless = facts.keyless;
        refused = facts.refused;
        unprotected = facts.unprotected;
        this.strangeAnswers = strangeAnswers;
    }

    /** Returns how many lines were dropped. */
    public long dropped() {
        return malformed + tooLong + strangeControl + keyless + refused;
    }
}
