package org.raspilot.up.loop;

/** One TCP connection, begun or made. Only on the loop. */
public interface TcpConnection {
    /**
     * Gives bytes to the system and returns how many it took, 0 to {@code length}; nothing is kept
     * here. When it took less, {@link TcpListener#onWritable} comes later. A connection that is not
     * made yet, or has ended, takes 0.
     */
    int write(byte[] bytes, int offset, int length);

    /**
     * Closes the connection immediately; the listener is not called afterwards. Later calls have no
     * effect.
     */
    void close();
}
