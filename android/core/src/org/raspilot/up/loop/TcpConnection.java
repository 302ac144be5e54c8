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

    /** Receives the events of one TCP connection. Called on the loop. */
    interface TcpListener {
        /** Called when the connection is open and can be written to. */
        void onConnected();

        /** Takes the first {@code length} bytes of {@code bytes}, which are reused afterwards. */
        void onBytes(byte[] bytes, int length);

        /** Called when a connection that accepted less than it was given has room again. */
        void onWritable();

        /**
         * Called once when the connection ended or failed to open; not after the own {@link
         * TcpConnection#close}.
         *
         * @param code {@code closed}, or one of TLS (docs/security.md)
         * @param reason a sentence without a full stop
         */
        void onClosed(String code, String reason);
    }
}
