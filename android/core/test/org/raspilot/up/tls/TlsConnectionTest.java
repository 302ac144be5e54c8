package org.raspilot.up.tls;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.io.File;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Random;
import org.junit.After;
import org.junit.Before;
import org.junit.Test;
import org.raspilot.up.loop.Faults;
import org.raspilot.up.loop.ManualLoop;
import org.raspilot.up.loop.ScriptedNetwork;
import org.raspilot.up.loop.TcpConnection.TcpListener;
import org.raspilot.up.wire.Vectors;

/** TLS on a scripted connection, with a real server's engine; tests/android has the real proxy. */
public final class TlsConnectionTest implements TcpListener {
    private static TlsIdentity relay;

    private final Faults faults = new Faults();
    private final ScriptedNetwork network = new ScriptedNetwork();
    private final ManualLoop loop = new ManualLoop(network, faults);
    /** The tasks for the other thread. */
    private final ArrayDeque<Runnable> aside = new ArrayDeque<>();
    private final List<String> told = new ArrayList<>();
    private TlsConnection connection;
    private ScriptedNetwork.Connection peer;
    private TlsServer server;
    private boolean isThrowing;

    @Before
    public void connect() throws Exception {
        if (relay == null) {
            relay = TlsIdentity.parse(text());
        }
        connection = new TlsConnection(loop, call -> aside.add(call), relay, "127.0.0.1", 3014, this);
        connection.connect(2000);
        peer = network.newest();
        server = new TlsServer(relay, peer);
    }

    @After
    public void nothingIsLeft() {
        connection.close();
        faults.mustBeNone();
        assertEquals(0, loop.pendingTimers());
    }

    static String text() throws Exception {
        return Vectors.text(new File(System.getProperty("vectors"), "tls.pem"));
    }

    @Override
    public void onConnected() {
        told.add("connected");
    }

    @Override
    public void onBytes(byte[] bytes, int length) {
        told.add(new String(bytes, 0, length));
        if (isThrowing) {
            isThrowing = false;
            throw new IllegalStateException("a listener");
        }
    }

    @Override
    public void onWritable() {
        told.add("writable");
    }

    @Override
    public void onClosed(String code, String reason) {
        told.add(code);
    }

    private boolean runAside() {
        final boolean isAny = !aside.isEmpty();
        if (isAny) {
            aside.remove().run();
        }
        return isAny;
    }

    /** Lets both ends go on until nothing moves. */
    private void settle() throws Exception {
        boolean isMoving = true;
        while (isMoving) {
            isMoving = runAside();
            loop.advance(0);
            isMoving |= server.pump();
        }
    }

    private void open() throws Exception {
        peer.accept();
        settle();
        assertEquals(Arrays.asList("connected"), told);
        told.clear();
    }

    private int write(String text) {
        return connection.write(Vectors.bytes(text), 0, text.length());
    }

    @Test
    public void dataTravelsBothWaysAfterTheHandshake() throws Exception {
        assertEquals(0, write("early"));
        open();
        assertEquals(5, write("hello"));
        settle();
        assertEquals("hello", server.heard.toString());
        server.say(Vectors.bytes("welcome"));
        assertEquals(Arrays.asList("welcome"), told);
    }

    @Test
    public void theVersionOfAndroidFiveToNineIsSpoken() throws Exception {
        server.speak("TLSv1.2");
        dataTravelsBothWaysAfterTheHandshake();
    }

    @Test
    public void whatTakesLongHoldsTheLoopNever() throws Exception {
        peer.accept();
        loop.advance(0);
        assertEquals("no engine yet", 0, peer.writtenBytes().length);
        int others = 0;
        while (runAside()) {
            others++;
            loop.advance(0);
            server.pump();
        }
        assertEquals(Arrays.asList("connected"), told);
        assertTrue("the certificate was judged on the loop: " + others, others > 1);
    }

    @Test
    public void noHandshakeInFiveSecondsIsTheEnd() throws Exception {
        peer.accept();
        runAside();
        loop.advance(4999);
        assertTrue(told.isEmpty());
        loop.advance(1);
        assertEquals(Arrays.asList("tls_timeout"), told);
        assertTrue(peer.isClosed);
    }

    @Test
    public void anEngineThatIsTooLateHarmsNobody() throws Exception {
        peer.accept();
        loop.advance(5000);
        runAside();
        loop.advance(0);
        assertEquals(Arrays.asList("tls_timeout"), told);
    }

    @Test
    public void aSystemThatTakesLittleGetsAllInOrder() throws Exception {
        peer.room = 100;
        peer.accept();
        for (int at = 0; at < 100 && told.isEmpty(); at++) {
            settle();
            peer.makeRoom(100);
        }
        told.clear();
        final byte[] sent = new byte[100000];
        new Random(4).nextBytes(sent);
        int taken = connection.write(sent, 0, sent.length);
        assertTrue("more than a record waits: " + taken, taken <= 16384);
        assertEquals(0, connection.write(sent, taken, 1));
        for (int at = 0; at < 100 && taken < sent.length; at++) {
            told.clear();
            peer.makeRoom(5000);
            server.pump();
            if (told.contains("writable")) {
                taken += connection.write(sent, taken, sent.length - taken);
            }
        }
        assertEquals(sent.length, taken);
        peer.makeRoom(Integer.MAX_VALUE);
        settle();
        assertArrayEquals(sent, server.heard.toByteArray());
    }

    @Test
    public void aListenerThatThrowsGetsTheRest() throws Exception {
        open();
        final byte[] one = server.record(Vectors.bytes("one"));
        final byte[] two = server.record(Vectors.bytes("two"));
        final byte[] both = Arrays.copyOf(one, one.length + two.length);
        System.arraycopy(two, 0, both, one.length, two.length);
        isThrowing = true;
        try {
            peer.listener.onBytes(both, both.length);
        } catch (IllegalStateException thrown) {
            assertEquals(Arrays.asList("one"), told);
        }
        loop.advance(0);
        assertEquals(Arrays.asList("one", "two"), told);
    }

    @Test
    public void anEndIsToldInBothDirections() throws Exception {
        open();
        connection.close();
        server.pump();
        assertTrue(server.isInboundDone());
        assertTrue(peer.isClosed);
        assertTrue(told.isEmpty());
        connect();
        open();
        server.end();
        assertEquals(Arrays.asList("closed"), told);
        assertTrue(peer.isClosed);
        assertEquals(0, write("late"));
    }

    @Test
    public void aChangedRecordIsTheEnd() throws Exception {
        open();
        final byte[] record = server.record(Vectors.bytes("one"));
        record[record.length - 1] ^= 1;
        peer.listener.onBytes(record, record.length);
        assertEquals(Arrays.asList("tls_failed"), told);
    }

    @Test
    public void aFloodWhileTheEngineIsBusyIsTheEnd() throws Exception {
        peer.accept();
        final byte[] flood = new byte[65536];
        flood[0] = 22;
        for (int at = 0; at < 5; at++) {
            assertTrue(told.isEmpty());
            peer.listener.onBytes(flood, flood.length);
        }
        assertEquals(Arrays.asList("tls_failed"), told);
    }

    @Test
    public void noConnectionIsThatOfTcp() {
        peer.end("Connection refused");
        assertEquals(Arrays.asList("closed"), told);
        assertFalse(runAside());
    }
}
