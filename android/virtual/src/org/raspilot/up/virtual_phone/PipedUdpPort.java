package org.raspilot.up.virtual_phone;

import org.raspilot.up.loop.UdpListener;
import org.raspilot.up.loop.UdpPort;

/** A UDP socket of a simulator. */
final class PipedUdpPort implements UdpPort {
    private final PipedNetwork network;
    private final long id;
    private final UdpListener listener;
    private boolean isClosed;

    /** Takes its number on the pipe. */
    PipedUdpPort(PipedNetwork network, long id, UdpListener listener) {
        this.network = network;
        this.id = id;
        this.listener = listener;
    }

    @Override
    public boolean send(byte[] datagram, String host, int port) {
        if (isClosed) {
            return false;
        }
        network.request("send", id, new String(datagram, PipedNetwork.BYTES), host, (long) port);
        return true;
    }

    @Override
    public void close() {
        if (!isClosed) {
            isClosed = true;
            network.remove(id);
            network.request("shut", id);
        }
    }

    void deliver(byte[] datagram, String host, int port) {
        listener.onDatagram(datagram, datagram.length, host, port);
    }
}
