package org.raspilot.up.net;

import java.util.Iterator;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.wire.LineSplitter;

/**
 * Splits the data of successive connections into lines and delivers each line once; an exception of
 * the receiver for one line does not affect the other lines.
 */
final class LineDispatcher {
    private final Loop loop;
    private final Receiver receiver;
    private final LineSplitter splitter = new LineSplitter();
    private Object connection;

    interface Receiver {
        /** Takes one without its line end. */
        void onLine(byte[] line);
    }

    LineDispatcher(Loop loop, Receiver receiver) {
        this.loop = loop;
        this.receiver = receiver;
    }

    /** Starts a connection: a partial line of the previous one is discarded. */
    void begin(Object begun) {
        connection = begun;
        splitter.reset();
    }

    /** Ends the connection: its data that is not delivered yet is discarded. */
    void end() {
        connection = null;
    }

    void feed(byte[] bytes, int length) {
        deliver(connection, splitter.feed(bytes, length).iterator());
    }

    private void deliver(final Object from, final Iterator<byte[]> lines) {
        boolean isDone = false;
        try {
            while (connection == from && lines.hasNext()) {
                receiver.onLine(lines.next());
            }
            isDone = true;
        } finally {
            if (!isDone) {
                loop.post(() -> deliver(from, lines));
            }
        }
    }
}
