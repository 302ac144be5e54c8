package org.raspilot.up.loop;

/** One UDP socket. Only on the loop. */
public interface UdpPort {
    /**
     * Sends a datagram to {@code host}, a name or an address, and returns whether the system
     * accepted it. An IPv4 address is used immediately. A name is looked up at the first datagram;
     * datagrams are lost until the lookup succeeds. The lookup is repeated once a minute.
     */
    boolean send(byte[] datagram, String host, int port);

    /** Closes the socket; its listener is not called afterwards. Later calls have no effect. */
    void close();

    /** Takes the datagrams of one UDP socket. Called on the loop. */
    interface UdpListener {
        /**
         * Takes a datagram: the first {@code length} bytes of {@code bytes}, which are reused
         * afterwards, from the numeric address {@code host} and {@code port}.
         */
        void onDatagram(byte[] bytes, int length, String host, int port);
    }
}
