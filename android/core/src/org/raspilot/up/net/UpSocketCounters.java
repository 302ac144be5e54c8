package org.raspilot.up.net;

/** What an {@link UpSocket} counted since it was made. */
public final class UpSocketCounters {
    public final long connects;
    public final long lost;
    /** How many lines or frames the system took whole, heartbeats not counted. */
    public final long sent;
    /** How many lines or frames were refused, or died with a connection. */
    public final long dropped;
    /** How many lines or frames a newer one replaced. */
    public final long replaced;
    /** How many lines that are not empty came; in raw mode how many reads. */
    public final long received;
    /** How many lines were dropped because they were too long. */
    public final long tooLong;
    /** How many bytes the system took. */
    public final long bytesOut;

    UpSocketCounters(long connects, long lost, long sent, long dropped, long replaced,
            long received, long tooLong, long bytesOut) {
        this.connects = connects;
        this.lost = lost;
        this.sent = sent;
        this.dropped = dropped;
        this.replaced = replaced;
        this.received = received;
        this.tooLong = tooLong;
        this.bytesOut = bytesOut;
    }
}
