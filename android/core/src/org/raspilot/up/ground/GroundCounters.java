package org.raspilot.up.ground;

/** What a {@link GroundSide} counted since it was made. Immutable. */
public final class GroundCounters {
    private final long connections;
    private final long frames;
    private final long lostFrames;
    private final long malformed;
    private final long tooLong;
    private final long strangeControl;
    private final long strangeAnswers;

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

    /** Returns how often the link became open. */
    public long connections() {
        return connections;
    }

    /** Returns how many frames of telemetry came. */
    public long frames() {
        return frames;
    }

    /** Returns how many frames were sent, by the beacons' numbers, and did not come. */
    public long lostFrames() {
        return lostFrames;
    }

    /** Returns how many lines were no General Messages. */
    public long malformed() {
        return malformed;
    }

    /** Returns how many lines were too long. */
    public long tooLong() {
        return tooLong;
    }

    /** Returns the number of unknown or unexpected lines of the proxy. */
    public long strangeControl() {
        return strangeControl;
    }

    /** Returns how many answers were of no Command that waits for one. */
    public long strangeAnswers() {
        return strangeAnswers;
    }

    /** Returns how many lines were dropped. */
    public long dropped() {
        return malformed + tooLong + strangeControl;
    }
}
