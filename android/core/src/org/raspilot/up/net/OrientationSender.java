package org.raspilot.up.net;

import java.io.IOException;
import java.util.Random;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.loop.UdpPort;

/**
 * Sends orientation frames (protocols 3) over TCP or UDP; a waiting frame is replaced by the next.
 * Its destination is the place of the General Message link and follows it immediately. Only on the
 * loop.
 */
public final class OrientationSender {
    private final Loop loop;
    private final LastEndpoint known;
    private final UpSocket socket;
    private UdpPort udp;
    private Endpoint followed;
    private boolean isStarted;

    /**
     * Creates a sender to the orientation port of {@code known}: by datagrams or on a connection
     * that is kept, whose retry waits vary by {@code random}.
     */
    public OrientationSender(Loop loop, LastEndpoint known, boolean isUdp, Random random) {
        this.loop = loop;
        this.known = known;
        socket = isUdp ? null : new UpSocket(loop, known.follower(),
                new UpSocketListener() { }, UpSocketSettings.raw(), random);
    }

    /** Starts to connect, or opens the socket; no effect when started already. */
    public void start() {
        if (!isStarted) {
            isStarted = true;
            followed = known.endpoint();
            if (socket != null) {
                socket.start();
            } else {
                openUdp();
            }
        }
    }

    /** Closes; may be started again. */
    public void stop() {
        isStarted = false;
        if (socket != null) {
            socket.stop();
        } else {
            closeUdp();
        }
    }

    /** Connects immediately instead of after the wait; on UDP reopens the socket. */
    public void reconnectNow() {
        if (!isStarted) {
            return;
        }
        if (socket != null) {
            socket.reconnectNow();
        } else {
            closeUdp();
            openUdp();
        }
    }

    /**
     * Reconnects an open connection immediately, as after a gap in the network in which it may have
     * died unnoticed; without one, like {@link #reconnectNow}.
     */
    public void replaceConnection(String reason) {
        if (isStarted && socket != null && socket.isConnected()) {
            socket.drop("replaced", reason);
        }
        reconnectNow();
    }

    /**
     * Sends a frame of 24 bytes.
     *
     * @return false when it was dropped: not connected, or the place is not known
     */
    public boolean send(byte[] frame) {
        if (!isStarted) {
            return false;
        }
        follow();
        return socket != null ? socket.sendNewest(this, frame) : sendDatagram(frame);
    }

    /** Returns whether frames can leave now. */
    public boolean isReady() {
        return socket != null ? socket.isConnected() : udp != null && hasPort();
    }

    private boolean sendDatagram(byte[] frame) {
        if (udp == null) {
            openUdp();
        }
        final Endpoint place = known.endpoint();
        return udp != null && hasPort()
                && udp.send(frame, place.host, place.orientationPort);
    }

    private boolean hasPort() {
        return known.endpoint() != null && known.endpoint().orientationPort != 0;
    }

    private void openUdp() {
        try {
            udp = loop.network().openUdp((bytes, length, host, port) -> {
                // Whatever comes is not for us.
            });
        } catch (IOException error) {
            udp = null; // The next frame tries again.
        }
    }

    private void closeUdp() {
        if (udp != null) {
            udp.close();
            udp = null;
        }
    }

    /** A connection to the Raspberry Pi's old address is useless, and so is waiting to retry it. */
    private void follow() {
        final Endpoint place = known.endpoint();
        if (socket != null && place != null && !place.equals(followed)) {
            followed = place;
            if (place.equals(socket.status().endpoint)) {
                reconnectNow();
            } else {
                replaceConnection("the Raspberry Pi is now at " + place.host);
            }
        }
    }
}
