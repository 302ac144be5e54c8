package org.raspilot.up.loop;

/** Hears what becomes of one TCP connection. Called on the loop. */
public interface TcpListener {
    /** Hears that the connection is there: it can be written to. */
    void onConnected();

    /** Takes the first {@code length} bytes of {@code bytes}, which are reused afterwards. */
    void onBytes(byte[] bytes, int length);

    /** Hears that a connection which took less than it was given takes more now. */
    void onWritable();

    /**
     * Hears, once, that the connection ended or could not be made; not told after the own
     * {@link TcpConnection#close}.
     *
     * @param reason a sentence without a full stop
     */
    void onClosed(String reason);
}
