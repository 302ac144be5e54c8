package org.raspilot.up.loop;

/** One UDP socket. Only on the loop. */
public interface UdpPort {
    /**
     * Sends a datagram to {@code host}, a name or an address, and returns whether the system took
     * it. An IPv4 address is used at once. A name is looked up at the first datagram, which is lost
     * like every one before the answer; it is looked up again once a minute.
     */
    boolean send(byte[] datagram, String host, int port);

    /** Closes the socket; its listener is not called any more. Twice without effect. */
    void close();
}
