package org.raspilot.up.wire;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

/**
 * Splits a stream of bytes into lines at LF and removes a CR before it, except from a binary line.
 *
 * <p>A line that is too long is dropped up to its LF; the buffer never exceeds the
 * bound. Empty lines are heartbeats and are left out. Source: docs/protocols.md 4.
 */
public final class LineSplitter {
    /** Bytes of a General Message line with its LF. */
    public static final int MAX_LINE_BYTES = 16384;

    private final int longestContent;
    private byte[] held = new byte[256];
    private int heldLength;
    private boolean isSkipping;

    public LineSplitter() {
        this(MAX_LINE_BYTES);
    }

    /** Creates a splitter for lines of at most {@code longestBytes}, LF included. */
    public LineSplitter(int longestBytes) {
        longestContent = longestBytes - 1;
    }

    /** Returns the lines that these bytes complete, without their line ends, in order. */
    public List<byte[]> feed(byte[] bytes, int length) {
        List<byte[]> lines = new ArrayList<>();
        int start = 0;
        for (int i = 0; i < length; i++) {
            if (bytes[i] == '\n') {
                hold(bytes, start, i);
                endLine(lines);
                start = i + 1;
            }
        }
        hold(bytes, start, length);
        return lines;
    }

    /** Discards an unfinished line: the next byte is another connection's. */
    public void reset() {
        heldLength = 0;
        isSkipping = false;
    }

    private void hold(byte[] bytes, int from, int to) {
        if (isSkipping) {
            return;
        }
        int length = heldLength + to - from;
        if (length > longestContent) {
            heldLength = 0;
            isSkipping = true;
            return;
        }
        if (length > held.length) {
            held = Arrays.copyOf(held, Math.min(longestContent, Math.max(length, 2 * held.length)));
        }
        System.arraycopy(bytes, from, held, heldLength, to - from);
        heldLength = length;
    }

    private void endLine(List<byte[]> lines) {
        int length = heldLength;
        if (length > 0 && held[length - 1] == '\r' && !BinaryLine.isType(held[0])) {
            length--;
        }
        if (length > 0 && !isSkipping) {
            lines.add(Arrays.copyOf(held, length));
        }
        reset();
    }
}
