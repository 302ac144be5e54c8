package org.raspilot.up.loop;

/** Receives the events of one TCP connection. Called on the loop. */
public interface TcpListener {
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
     * @param reason a sentence without a full stop
     */
    void onClosed(String reason);
}
