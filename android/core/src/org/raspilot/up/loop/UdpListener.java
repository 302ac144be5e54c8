package org.raspilot.up.loop;

/** Takes the datagrams of one UDP socket. Called on the loop. */
public interface UdpListener {
    /**
     * Takes a datagram: the first {@code length} bytes of {@code bytes}, which are reused
     * afterwards, from the numeric address {@code host} and {@code port}.
     */
    void onDatagram(byte[] bytes, int length, String host, int port);
}
