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
    /** How many answers were of no Command that waits for one. */
    public final long strangeAnswers;

    GroundCounters(long connections, long frames, long lostFrames, long malformed, long tooLong,
            long strangeControl, long strangeAnswers) {
        this.connections = connections;
        this.frames = frames;
        this.lostFrames = lostFrames;
        this.malformed = malformed;
        this.tooLong = tooLong;
        this.strangeControl = strangeControl;
        this.strangeAnswers = strangeAnswers;
    }

    /** Returns how many lines were dropped. */
    public long dropped() {
        return malformed + tooLong + strangeControl;
    }
}
