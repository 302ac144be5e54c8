package org.raspilot.up.loop;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.io.IOException;
import java.net.DatagramPacket;
import java.net.DatagramSocket;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.UnknownHostException;
import java.nio.charset.Charset;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.atomic.AtomicInteger;
import org.junit.After;
import org.junit.Before;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.loop.UdpPort.UdpListener;

public final class SelectorLoopUdpTest implements UdpListener {
    private static final Charset ASCII = Charset.forName("US-ASCII");

    @Rule
    public final RunningLoop running = new RunningLoop();
    private final List<String> heard = new ArrayList<>();
    private DatagramSocket peer;
    private UdpPort port;

    @Before
    public void open() throws IOException {
        peer = new DatagramSocket(new InetSocketAddress(InetAddress.getByName("0.0.0.0"), 0));
        peer.setSoTimeout(20000);
        port = running.call(() -> running.loop.openUdp(SelectorLoopUdpTest.this));
    }

    @After
    public void close() {
        peer.close();
    }

    @Override
    public void onDatagram(byte[] bytes, int length, String host, int from) {
        heard.add(new String(bytes, 0, length, ASCII) + " from " + host + ":" + from);
    }

    @Test
    public void datagramsTravelBothWays() throws Exception {
        assertTrue(send("127.0.0.1"));
        final DatagramPacket question = receive();
        assertEquals("where?", text(question));
        answer("here", question);
        answer("", question);
        running.await("the answers", hasHeard(2));
        final String source = " from 127.0.0.1:" + peer.getLocalPort();
        assertEquals("here" + source, heard.get(0));
        assertEquals(source, heard.get(1));
        running.faults.mustBeNone();
    }

    @Test
    public void broadcastIsAllowed() throws Exception {
        assertTrue(send("127.255.255.255"));
        assertEquals("where?", text(receive()));
    }

    @Test
    public void aNameIsLookedUpAsideAndThenUsed() throws Exception {
        assertFalse(send("localhost"));
        running.await("the name", () ->
                port.send("where?".getBytes(ASCII), "localhost", peer.getLocalPort()));
        assertEquals("where?", text(receive()));
    }

    @Test
    public void aNameThatNobodyKnowsIsNotAskedForAtEachDatagram() throws Exception {
        final AtomicInteger looks = new AtomicInteger();
        final RunningLoop other = new RunningLoop(new SocketSelector(), host -> {
            looks.incrementAndGet();
            throw new UnknownHostException(host);
        });
        other.before();
        try {
            final UdpPort from = other.call(() -> other.loop.openUdp(SelectorLoopUdpTest.this));
            final Callable<Boolean> send = () -> from.send(new byte[1], "pi.example", 1);
            final long beganMs = other.loop.nowMs();
            for (int each = 0; each < 30; each++) {
                assertFalse(other.call(send));
                other.pass(5);
            }
            final long most = 1 + (other.loop.nowMs() - beganMs) / 2000;
            assertTrue(looks + " look-ups", looks.get() >= 1 && looks.get() <= most);
            other.sleep(2001);
            final int before = looks.get();
            other.await("another look-up", () -> {
                send.call();
                return looks.get() > before;
            });
        } finally {
            other.after();
        }
    }

    @Test
    public void aClosedPortTakesNothing() {
        running.call(() -> {
            port.close();
            port.close();
            return null;
        });
        assertFalse(send("127.0.0.1"));
    }

    @Test
    public void anImpossiblePortTakesNothing() {
        for (final int none : new int[] {0, -1, 65536}) {
            assertFalse(running.call(() -> port.send(new byte[1], "127.0.0.1", none)));
        }
    }

    private boolean send(final String host) {
        return running.call(() -> port.send("where?".getBytes(ASCII), host, peer.getLocalPort()));
    }

    private DatagramPacket receive() throws IOException {
        final DatagramPacket packet = new DatagramPacket(new byte[100], 100);
        peer.receive(packet);
        return packet;
    }

    private void answer(String text, DatagramPacket question) throws IOException {
        final byte[] bytes = text.getBytes(ASCII);
        peer.send(new DatagramPacket(bytes, bytes.length, question.getSocketAddress()));
    }

    private static String text(DatagramPacket packet) {
        return new String(packet.getData(), 0, packet.getLength(), ASCII);
    }

    private Callable<Boolean> hasHeard(final int count) {
        return () -> heard.size() >= count;
    }
}
