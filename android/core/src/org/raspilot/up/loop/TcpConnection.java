package org.raspilot.up.loop;

/** One TCP connection, open or in progress. Only on the loop. */
public interface TcpConnection {
    /**
     * Writes bytes to the system and returns how many it accepted, 0 to {@code length}; nothing is
     * buffered here. If it accepted less, {@link TcpListener#onWritable} follows later. A
     * connection that is not open accepts 0.
     */
    int write(byte[] bytes, int offset, int length);

    /** Closes immediately; the listener is not called afterwards. Idempotent. */
    void close();
}
