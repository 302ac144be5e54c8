package org.raspilot.up.net;

/** What an {@link UpSocket} counted since it was made. */
public final class UpSocketCounters {
    private final long connects;
    private final long failedAttempts;
    private final long lost;
    private final long sent;
    private final long dropped;
    private final long replaced;
    private final long received;
    private final long tooLong;
    private final long bytesIn;
    private final long bytesOut;

    UpSocketCounters(long connects, long failedAttempts, long lost, long sent, long dropped,
            long replaced, long received, long tooLong, long bytesIn, long bytesOut) {
        this.connects = connects;
        this.failedAttempts = failedAttempts;
        this.lost = lost;
        this.sent = sent;
        this.dropped = dropped;
        this.replaced = replaced;
        this.received = received;
        this.tooLong = tooLong;
        this.bytesIn = bytesIn;
        this.bytesOut = bytesOut;
    }

    /** Returns how many connections were made. */
    public long connects() {
        return connects;
    }

    /** Returns how many attempts found no place or made no connection. */
    public long failedAttempts() {
        return failedAttempts;
    }

    /** Returns how many connections were lost. */
    public long lost() {
        return lost;
    }

    /** Returns how many lines or frames the system took whole, heartbeats not counted. */
    public long sent() {
        return sent;
    }

    /** Returns how many lines or frames were refused, or died with a connection. */
    public long dropped() {
        return dropped;
    }

    /** Returns how many lines or frames a newer one replaced. */
    public long replaced() {
        return replaced;
    }

    /** Returns how many lines that are not empty came; in raw mode how many reads. */
    public long received() {
        return received;
    }

    /** Returns how many lines were dropped because they were too long. */
    public long tooLong() {
        return tooLong;
    }

    /** Returns how many bytes came. */
    public long bytesIn() {
        return bytesIn;
    }

    /** Returns how many bytes the system took. */
    public long bytesOut() {
        return bytesOut;
    }
}
