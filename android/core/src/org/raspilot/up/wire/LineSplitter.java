package org.raspilot.up.wire;

import java.util.ArrayList;
import java.util.List;

/**
 * Cuts a stream of bytes into lines at LF and takes a CR before it away.
 *
 * <p>A line that is too long is dropped up to its LF and counted; what is held never grows beyond
 * the bound. Empty lines are heartbeats and are left out. Source: docs/protocols.md 4.
 */
public final class LineSplitter {
    /** Bytes of a General Message line with its LF. */
    public static final int LONGEST_LINE = 16384;

    /** Makes a splitter for lines of General Messages. */
    public LineSplitter() {
        this(LONGEST_LINE);
    }

    /** Makes a splitter for lines of at most {@code longestBytes}, LF included. */
    public LineSplitter(int longestBytes) {
    }

    /** Returns the lines that these bytes complete, without their line ends, in order. */
    public List<byte[]> feed(byte[] bytes, int length) {
        return new ArrayList<byte[]>();
    }

    /** Forgets an unfinished line: the next byte is another connection's. */
    public void reset() {
    }

    /** Returns how many lines were dropped because they were too long. */
    public long droppedTooLong() {
        return 0;
    }
}
