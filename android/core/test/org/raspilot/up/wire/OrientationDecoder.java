package org.raspilot.up.wire;

import java.util.ArrayList;
import java.util.List;

/** Finds frames in the bytes of one connection; holds less than one (docs/protocols.md 3). */
public final class OrientationDecoder {
    private final byte[] held = new byte[OrientationFrame.SIZE];
    private int heldLength;
    private long dropped;

    /** Creates a decoder for one connection. */
    public OrientationDecoder() {
    }

    /** Returns the frames that these bytes complete, in order. */
    public List<OrientationFrame> feed(byte[] bytes, int length) {
        List<OrientationFrame> frames = new ArrayList<>();
        int at = 0;
        while (at < length) {
            int taken = Math.min(OrientationFrame.SIZE - heldLength, length - at);
            System.arraycopy(bytes, at, held, heldLength, taken);
            heldLength += taken;
            at += taken;
            if (heldLength == OrientationFrame.SIZE) {
                heldLength = 0;
                OrientationFrame frame = OrientationFrame.read(held, 0, OrientationFrame.SIZE);
                if (frame == null) {
                    dropped++;
                } else {
                    frames.add(frame);
                }
            }
        }
        return frames;
    }

    /** Discards an unfinished frame: the next byte is another connection's. */
    public void reset() {
        heldLength = 0;
    }

    /** Returns how many frames had a value that is not finite or out of range. */
    public long dropped() {
        return dropped;
    }
}
