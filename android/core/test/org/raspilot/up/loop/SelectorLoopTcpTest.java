package org.raspilot.up.loop;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import java.io.DataInputStream;
import java.io.IOException;
import java.net.InetAddress;
import java.net.ServerSocket;
import java.net.Socket;
import java.util.Arrays;
import java.util.Random;
import org.junit.After;
import org.junit.Before;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.loop.TcpConnection.TcpListener;

public final class SelectorLoopTcpTest {
    private static final int LONG_MS = 20000;

    @Rule
    public final RunningLoop running = new RunningLoop();
    private final SelectorLoop loop = running.loop;
    private final Heard heard = new Heard();
    private ServerSocket server;

    @Before
    public void listen() throws IOException {
        server = new ServerSocket(0, 50, InetAddress.getByName("127.0.0.1"));
        server.setSoTimeout(LONG_MS);
    }

    @After
    public void close() throws IOException {
        server.close();
    }

    @Test
    public void bytesTravelBothWays() throws Exception {
        final TcpConnection connection = connect("127.0.0.1", server.getLocalPort(), heard);
        final Socket peer = accept();
        running.await("connected", heard.has("connected"));
        assertEquals(3, write(connection, new byte[] {1, 2, 3}));
        final byte[] got = new byte[3];
        new DataInputStream(peer.getInputStream()).readFully(got);
        assertArrayEquals(new byte[] {1, 2, 3}, got);
        peer.getOutputStream().write(new byte[] {4, 5});
        running.await("bytes", heard.hasBytes(2));
        assertArrayEquals(new byte[] {4, 5}, heard.bytes.toByteArray());
        peer.close();
        running.await("the end", heard.has("127.0.0.1:"));
        assertEquals(Arrays.asList("connected",
                "127.0.0.1:" + server.getLocalPort() + " closed the connection"), heard.told);
        assertEquals(0, write(connection, new byte[] {1}));
        running.faults.mustBeNone();
    }

    @Test
    public void aPeerThatDoesNotReadStopsTheWriterAndLetsItGoOn() throws Exception {
        final TcpConnection connection = connect("127.0.0.1", server.getLocalPort(), heard);
        final Socket peer = accept();
        running.await("connected", heard.has("connected"));
        final byte[] sent = new byte[16 << 20];
        new Random(6).nextBytes(sent);
        final int taken = write(connection, sent);
        assertTrue("took " + taken, taken > 0 && taken < sent.length);
        final byte[] got = new byte[taken];
        new DataInputStream(peer.getInputStream()).readFully(got);
        assertArrayEquals(Arrays.copyOf(sent, taken), got);
        running.await("room", heard.has("writable"));
        assertAsleep();
        peer.close();
        running.faults.mustBeNone();
    }

    @Test
    public void aRefusalIsASentence() throws Exception {
        final int port = server.getLocalPort();
        server.close();
        connect("127.0.0.1", port, heard);
        running.await("the refusal", heard.has("no connection"));
        assertTrue(heard.told.get(0).endsWith("127.0.0.1:" + port + ": Connection refused"));
        for (final int none : new int[] {0, -1, 65536}) {
            final Heard other = new Heard();
            connect("127.0.0.1", none, other);
            running.await("the refusal", other.has("no port: " + none));
        }
    }

    @Test
    public void aBlackHoleIsASentenceAfterTheTimeOut() throws Exception {
        final BlackHole hole = new BlackHole();
        try {
            running.call(() -> loop.connectTcp("127.0.0.1", hole.port(), 150, heard));
            running.await("the time-out", heard.has("no answer"));
            assertEquals(1, heard.told.size());
        } finally {
            hole.close();
        }
    }

    @Test
    public void nothingIsToldAfterTheOwnClose() throws Exception {
        final BlackHole hole = new BlackHole();
        try {
            running.call(() -> {
                final TcpConnection connecting =
                        loop.connectTcp("127.0.0.1", hole.port(), 50, heard);
                connecting.close();
                connecting.close();
                loop.connectTcp("127.0.0.1", 0, 50, heard).close();
                return null;
            });
            final TcpConnection connection = connect("127.0.0.1", server.getLocalPort(), heard);
            final Socket peer = accept();
            running.await("connected", heard.has("connected"));
            peer.getOutputStream().write(1);
            running.call(() -> {
                heard.bytes.reset();
                connection.close();
                return null;
            });
            assertEquals(-1, peer.getInputStream().read());
            running.pass(100);
            assertEquals(Arrays.asList("connected"), heard.told);
            assertEquals(0, heard.bytes.size());
        } finally {
            hole.close();
        }
    }

    @Test
    public void whatThePeerSaidBeforeItHungUpIsHeard() throws Exception {
        final TcpConnection connection = connect("127.0.0.1", server.getLocalPort(), heard);
        final Socket peer = accept();
        running.await("connected", heard.has("connected"));
        final String words = "UP1 error code=taken";
        final int[] writes = new int[1];
        // While another socket is handled, so that the writes fail before the loop reads again.
        connect("127.0.0.1", server.getLocalPort(), new Heard() {
            @Override
            public void onBytes(byte[] read, int length) {
                try {
                    peer.getOutputStream().write(words.getBytes("US-ASCII"));
                    peer.setSoLinger(true, 0);
                    peer.close();
                } catch (IOException error) {
                    throw new IllegalStateException(error);
                }
                while (writes[0] < 1000 && connection.write(new byte[1], 0, 1) == 1) {
                    writes[0]++;
                }
            }
        });
        accept().getOutputStream().write(1);
        running.await("the end", () -> heard.told.size() > 1);
        assertTrue("wrote " + writes[0], writes[0] < 1000);
        assertEquals(words, heard.bytes.toString("US-ASCII"));
        assertEquals(2, heard.told.size());
        running.faults.mustBeNone();
    }

    @Test
    public void stopClosesSocketsAndTellsNobody() throws Exception {
        connect("127.0.0.1", server.getLocalPort(), heard);
        final Socket peer = accept();
        running.await("connected", heard.has("connected"));
        final BlackHole hole = new BlackHole();
        try {
            connect("127.0.0.1", hole.port(), heard);
            loop.stop();
            assertEquals(-1, peer.getInputStream().read());
            assertEquals(Arrays.asList("connected"), heard.told);
        } finally {
            hole.close();
        }
        running.faults.mustBeNone();
    }

    @Test
    public void closedSocketsLeaveTheLoopAsleep() throws Exception {
        for (int i = 0; i < 40; i++) {
            final Heard each = new Heard();
            final TcpConnection connection = connect("127.0.0.1", server.getLocalPort(), each);
            final Socket peer = accept();
            running.await("connected", each.has("connected"));
            if (i % 2 == 0) {
                peer.setSoLinger(true, 0);
                peer.close();
                running.await("the end", each.has("the connection to"));
            } else {
                running.call(() -> {
                    connection.close();
                    return null;
                });
                peer.close();
            }
        }
        assertAsleep();
        running.faults.mustBeNone();
    }

    @Test
    public void aListenerThatThrowsHarmsNoOtherConnection() throws Exception {
        final Heard thrower = new Heard() {
            @Override
            public void onBytes(byte[] read, int length) {
                super.onBytes(read, length);
                throw new IllegalStateException("a listener");
            }
        };
        connect("127.0.0.1", server.getLocalPort(), thrower);
        final Socket first = accept();
        connect("127.0.0.1", server.getLocalPort(), heard);
        final Socket second = accept();
        first.getOutputStream().write(1);
        running.await("its bytes", thrower.hasBytes(1));
        first.getOutputStream().write(2);
        second.getOutputStream().write(3);
        running.await("its further bytes", thrower.hasBytes(2));
        running.await("the other's bytes", heard.hasBytes(1));
        assertEquals(2, running.faults.takeAll().size());
    }

    @Test
    public void aCallThatLeavesItsThreadInterruptedKeepsNobodyAwake() throws Exception {
        final TcpConnection connection = connect("127.0.0.1", server.getLocalPort(), heard);
        final Socket peer = accept();
        running.await("connected", heard.has("connected"));
        loop.post(() -> Thread.currentThread().interrupt());
        assertAsleep();
        assertEquals(1, write(connection, new byte[] {7}));
        assertEquals(7, peer.getInputStream().read());
        peer.getOutputStream().write(8);
        running.await("bytes", heard.hasBytes(1));
        assertEquals(Arrays.asList("connected"), heard.told);
    }

    private void assertAsleep() {
        running.pass(1);
        final long before = loop.rounds();
        running.pass(300);
        final long rounds = loop.rounds() - before;
        assertTrue("woke " + rounds + " times", rounds <= 6);
    }

    private TcpConnection connect(final String host, final int port, final TcpListener listener) {
        return running.call(() -> loop.connectTcp(host, port, LONG_MS, listener));
    }

    private Socket accept() throws IOException {
        final Socket peer = server.accept();
        peer.setSoTimeout(LONG_MS);
        return peer;
    }

    private int write(final TcpConnection connection, final byte[] bytes) {
        return running.call(() -> connection.write(bytes, 0, bytes.length));
    }
}
