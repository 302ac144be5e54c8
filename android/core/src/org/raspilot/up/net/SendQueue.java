package org.raspilot.up.net;

import java.util.ArrayDeque;
import java.util.Iterator;
import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.loop.TcpConnection;
import org.raspilot.up.wire.LineSplitter;

/**
 * Data that waits until the system accepts it: first the rest of a partial write, then ordered
 * messages, then the newest message of each key.
 */
final class SendQueue {
    private static final int MAX_BYTES = UpSocketSettings.MAX_QUEUE_BYTES;
    private static final byte LF = '\n';

    private final boolean isRaw;
    private final ArrayDeque<byte[]> ordered = new ArrayDeque<>();
    private final Map<Object, byte[]> newest = new LinkedHashMap<>();
    private byte[] partial;
    private int written;
    private int orderedBytes;
    private int newestBytes;
    private long sent;
    private long replaced;
    private long bytesOut;

    /** Creates a queue of raw frames, or of lines, of at most 64 KiB in order or newest. */
    SendQueue(boolean isRaw) {
        this.isRaw = isRaw;
    }

    /** Queues a copy in order; returns false when the queue is full or the message is too long. */
    boolean add(byte[] given) {
        final byte[] bytes = whole(given);
        if (!isSendable(bytes) || orderedBytes + bytes.length > MAX_BYTES) {
            return false;
        }
        orderedBytes += bytes.length;
        ordered.add(bytes);
        return true;
    }

    /** Queues a copy, replacing the one with the same key; returns false as {@link #add} does. */
    boolean replace(Object key, byte[] given) {
        final byte[] bytes = whole(given);
        final byte[] older = newest.get(key);
        final int grownBytes = newestBytes + bytes.length - (older == null ? 0 : older.length);
        if (!isSendable(bytes) || grownBytes > MAX_BYTES) {
            return false;
        }
        newestBytes = grownBytes;
        // The older message's position is kept, so that no key starves.
        newest.put(key, bytes);
        if (older != null) {
            replaced++;
        }
        return true;
    }

    /** Writes what the connection accepts now. Unstarted messages stay replaceable. */
    void flush(TcpConnection connection) {
        if (partial != null && !writeRest(connection)) {
            return;
        }
        while (!ordered.isEmpty()) {
            final byte[] first = ordered.peek();
            final int taken = write(connection, first, 0);
            if (taken == 0) {
                return;
            }
            ordered.remove();
            orderedBytes -= first.length;
            if (!isWhole(first, taken)) {
                return;
            }
        }
        final Iterator<byte[]> each = newest.values().iterator();
        while (each.hasNext()) {
            final byte[] next = each.next();
            final int taken = write(connection, next, 0);
            if (taken == 0) {
                return;
            }
            each.remove();
            newestBytes -= next.length;
            if (!isWhole(next, taken)) {
                return;
            }
        }
    }

    /** Clears the queue: the connection is gone. Returns the number of dropped lines or frames. */
    int clear() {
        final int count = ordered.size() + newest.size() + (partial != null ? 1 : 0);
        ordered.clear();
        newest.clear();
        orderedBytes = 0;
        newestBytes = 0;
        partial = null;
        written = 0;
        return count;
    }

    boolean isEmpty() {
        return partial == null && ordered.isEmpty() && newest.isEmpty();
    }

    int waitingBytes() {
        return orderedBytes + newestBytes + (partial == null ? 0 : partial.length - written);
    }

    long sent() {
        return sent;
    }

    long replaced() {
        return replaced;
    }

    long bytesOut() {
        return bytesOut;
    }

    /** Counts bytes that bypassed the queue. */
    void wrote(int bytes) {
        bytesOut += bytes;
    }

    private byte[] whole(byte[] bytes) {
        if (isRaw || bytes.length > 0 && bytes[bytes.length - 1] == LF) {
            return bytes.clone();
        }
        final byte[] whole = new byte[bytes.length + 1];
        System.arraycopy(bytes, 0, whole, 0, bytes.length);
        whole[bytes.length] = LF;
        return whole;
    }

    private boolean isSendable(byte[] bytes) {
        return bytes.length > 0 && (isRaw || bytes.length <= LineSplitter.MAX_LINE_BYTES);
    }

    private boolean writeRest(TcpConnection connection) {
        final byte[] bytes = partial;
        final int taken = write(connection, bytes, written);
        partial = null;
        return isWhole(bytes, written + taken);
    }

    private int write(TcpConnection connection, byte[] bytes, int offset) {
        final int taken = connection.write(bytes, offset, bytes.length - offset);
        bytesOut += taken;
        return taken;
    }

    /** Counts sent bytes, or keeps the rest to be finished before all others. */
    private boolean isWhole(byte[] bytes, int gone) {
        if (gone == bytes.length) {
            sent++;
            return true;
        }
        partial = bytes;
        written = gone;
        return false;
    }
}
