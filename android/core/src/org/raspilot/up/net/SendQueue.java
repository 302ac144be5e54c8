package org.raspilot.up.net;

import java.util.ArrayDeque;
import java.util.Arrays;
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
        return true;
    }

    /**
     * Writes what the connection accepts now and returns how many bytes; unstarted messages stay
     * replaceable.
     */
    int flush(TcpConnection connection) {
        int all = 0;
        for (byte[] next = next(); next != null; next = next()) {
            final int taken = connection.write(next, written, next.length - written);
            all += taken;
            if (taken > 0 && partial == null) {
                removeNext();
            }
            written += taken;
            if (written < next.length) {
                partial = written > 0 ? next : null;
                return all;
            }
            partial = null;
            written = 0;
        }
        return all;
    }

    /** Clears the queue: the connection is gone. */
    void clear() {
        ordered.clear();
        newest.clear();
        orderedBytes = 0;
        newestBytes = 0;
        partial = null;
        written = 0;
    }

    boolean isEmpty() {
        return next() == null;
    }

    private byte[] next() {
        if (partial != null) {
            return partial;
        }
        if (!ordered.isEmpty()) {
            return ordered.peek();
        }
        return newest.isEmpty() ? null : newest.values().iterator().next();
    }

    private void removeNext() {
        if (!ordered.isEmpty()) {
            orderedBytes -= ordered.remove().length;
            return;
        }
        final Iterator<byte[]> each = newest.values().iterator();
        newestBytes -= each.next().length;
        each.remove();
    }

    private byte[] whole(byte[] bytes) {
        if (isRaw || bytes.length > 0 && bytes[bytes.length - 1] == LF) {
            return bytes.clone();
        }
        final byte[] whole = Arrays.copyOf(bytes, bytes.length + 1);
        whole[bytes.length] = LF;
        return whole;
    }

    private boolean isSendable(byte[] bytes) {
        return bytes.length > 0 && (isRaw || bytes.length <= LineSplitter.MAX_LINE_BYTES);
    }
}
