package org.raspilot.up.net;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertEquals;

import java.net.DatagramPacket;
import java.net.DatagramSocket;
import java.net.InetAddress;
import java.util.Arrays;
import java.util.Random;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.loop.RunningLoop;

/** Frames over real sockets. */
public final class OrientationOnLoopbackTest {
    @Rule
    public final RunningLoop running = new RunningLoop();
    @Rule
    public final Peer peer = new Peer();

    @Test
    public void overTcpFramesComeBackToBack() throws Exception {
        final OrientationSender sender = start(peer.place(), OrientationSender.Transport.TCP);
        peer.accept();
        running.await("ready", () -> sender.isReady());
        final byte[] got = new byte[48];
        send(sender, 1);
        send(sender, 2);
        peer.in().readFully(got);
        assertArrayEquals(frame(1), Arrays.copyOf(got, 24));
        assertArrayEquals(frame(2), Arrays.copyOfRange(got, 24, 48));
        running.faults.mustBeNone();
    }

    @Test
    public void overUdpEachFrameIsADatagram() throws Exception {
        final DatagramSocket server = new DatagramSocket(0, InetAddress.getByName("127.0.0.1"));
        server.setSoTimeout(20000);
        final OrientationSender sender = start(new Endpoint("127.0.0.1", 1, server.getLocalPort()),
                OrientationSender.Transport.UDP);
        for (int i = 0; i < 3; i++) {
            send(sender, i);
            final DatagramPacket packet = new DatagramPacket(new byte[100], 100);
            server.receive(packet);
            assertEquals(24, packet.getLength());
            assertArrayEquals(frame(i), Arrays.copyOf(packet.getData(), 24));
        }
        server.close();
        running.faults.mustBeNone();
    }

    private OrientationSender start(final Endpoint place, OrientationSender.Transport transport) {
        final LastEndpoint known = new LastEndpoint(new FixedEndpoint(place));
        final OrientationSender sender =
                new OrientationSender(running.loop, known, transport, new Random(6));
        return running.call(() -> {
            known.find(new Found());
            sender.start();
            return sender;
        });
    }

    private void send(final OrientationSender sender, final int content) {
        assertEquals(true, running.call(() -> sender.send(frame(content))));
    }

    private static byte[] frame(int content) {
        final byte[] frame = new byte[24];
        Arrays.fill(frame, (byte) content);
        return frame;
    }
}
