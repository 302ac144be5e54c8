package org.raspilot.up.net;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.util.Arrays;
import java.util.Random;
import org.junit.After;
import org.junit.Test;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Faults;
import org.raspilot.up.loop.ManualLoop;
import org.raspilot.up.loop.ScriptedNetwork;

public final class OrientationSenderTest {
    private final Faults faults = new Faults();
    private final ScriptedNetwork network = new ScriptedNetwork();
    private final ManualLoop loop = new ManualLoop(network, faults);
    private Endpoint answer = new Endpoint("192.0.2.7", 50001, 50000);
    private final LastEndpoint known = new LastEndpoint(listener -> {
        if (answer == null) {
            listener.onNotFound("not_found", "nowhere");
        } else {
            listener.onFound(answer);
        }
        return Cancellable.DONE;
    });
    private final OrientationSender tcp = sender(false);
    private final OrientationSender udp = sender(true);

    @After
    public void nothingWasThrown() {
        faults.mustBeNone();
    }

    @Test
    public void overTcpTheNewestFrameReplacesTheOneThatWaits() {
        find();
        tcp.start();
        assertEquals(50000, network.newest().port);
        network.newest().accept();
        assertTrue(tcp.isReady());
        network.newest().room = 30;
        for (char each = 'a'; each <= 'z'; each++) {
            assertTrue(tcp.send(frame(each)));
        }
        network.newest().makeRoom(1000);
        assertEquals(text('a') + text('b') + text('z'), network.newest().written());
    }

    @Test
    public void overTcpNoHalfFrameCrossesConnections() {
        find();
        tcp.start();
        network.newest().accept();
        network.newest().room = 10;
        tcp.send(frame('a'));
        network.newest().end("broke");
        assertFalse(tcp.send(frame('b')));
        loop.advance(600);
        network.newest().accept();
        tcp.send(frame('c'));
        assertEquals(text('c'), network.newest().written());
    }

    @Test
    public void aStalledTcpConnectionIsReplaced() {
        find();
        tcp.start();
        network.newest().accept();
        network.newest().room = 0;
        for (int i = 0; i < 800 && network.connections.size() == 1; i++) {
            tcp.send(frame('a'));
            loop.advance(5);
        }
        assertEquals(2, network.connections.size());
        assertTrue("within 3.6 s", loop.nowMs() <= 3610);
    }

    @Test
    public void aConnectionThatMayBeDeadIsReplacedAtOnce() {
        find();
        tcp.start();
        tcp.replaceConnection("may be dead");
        assertEquals(1, network.connections.size());
        network.newest().accept();
        tcp.replaceConnection("may be dead");
        assertTrue(network.connections.get(0).isClosed);
        assertEquals(2, network.connections.size());
        network.newest().accept();
        assertTrue(tcp.send(frame('a')));
        assertEquals(text('a'), network.newest().written());
        udp.start();
        udp.replaceConnection("may be dead");
        assertTrue(network.ports.get(0).isClosed);
        assertEquals(2, network.ports.size());
    }

    @Test
    public void overTcpItFollowsTheRaspberryPiAtOnce() {
        tcp.start();
        assertFalse(tcp.isReady());
        assertFalse(tcp.send(frame('a')));
        assertTrue(network.connections.isEmpty());
        find();
        tcp.send(frame('b'));
        assertEquals("192.0.2.7", network.newest().host);
        network.newest().accept();
        answer = new Endpoint("192.0.2.8", 1, 2);
        find();
        assertFalse(tcp.send(frame('c')));
        assertTrue(network.connections.get(0).isClosed);
        assertEquals("192.0.2.8", network.newest().host);
        network.newest().accept();
        assertTrue(tcp.send(frame('d')));
        assertEquals(text('d'), network.newest().written());
        answer = new Endpoint("192.0.2.8", 1, 2);
        find();
        assertTrue(tcp.send(frame('e')));
        assertEquals(2, network.connections.size());
    }

    @Test
    public void overUdpEachFrameIsADatagram() {
        udp.start();
        assertFalse(udp.isReady());
        assertFalse(udp.send(frame('a')));
        find();
        assertTrue(udp.isReady());
        assertTrue(udp.send(frame('b')));
        answer = new Endpoint("192.0.2.8", 1, 2);
        find();
        assertTrue(udp.send(frame('c')));
        assertEquals(Arrays.asList(text('b') + " -> 192.0.2.7:50000",
                text('c') + " -> 192.0.2.8:2"), network.ports.get(0).sent);
        network.ports.get(0).hasNoNetwork = true;
        assertFalse(udp.send(frame('d')));
        answer = new Endpoint("192.0.2.8", 1, 0);
        find();
        assertFalse(udp.send(frame('e')));
    }

    @Test
    public void overUdpASocketThatCannotBeHadIsTriedAgain() {
        find();
        network.hasNoSockets = true;
        udp.start();
        assertFalse(udp.send(frame('a')));
        network.hasNoSockets = false;
        assertTrue(udp.send(frame('b')));
        udp.reconnectNow();
        assertTrue(network.ports.get(0).isClosed);
        assertTrue(udp.send(frame('c')));
        assertEquals(2, network.ports.size());
    }

    @Test
    public void aStoppedSenderSendsNothing() {
        find();
        for (OrientationSender each : new OrientationSender[] {tcp, udp}) {
            assertFalse(each.send(frame('a')));
            each.start();
            each.start();
            each.stop();
            each.reconnectNow();
            assertFalse(each.send(frame('a')));
            assertFalse(each.isReady());
        }
        assertEquals(1, network.connections.size());
        assertTrue(network.newest().isClosed);
        assertEquals(1, network.ports.size());
        assertTrue(network.ports.get(0).isClosed);
        assertEquals(0, loop.pendingTimers());
    }

    @Test
    public void whatIsKnownStays() {
        final Found early = new Found();
        known.follower().find(early);
        assertEquals(Arrays.asList("not_found"), early.codes);
        final Found asked = new Found();
        known.find(asked);
        answer = null;
        known.find(asked);
        known.follower().find(asked);
        assertEquals(Arrays.asList("192.0.2.7:50001:50000", "nowhere", "192.0.2.7:50001:50000"),
                asked.told);
    }

    private void find() {
        known.find(new Found());
    }

    private OrientationSender sender(boolean isUdp) {
        return new OrientationSender(loop, known, isUdp, new Random(6));
    }

    private static byte[] frame(char letter) {
        final byte[] frame = new byte[24];
        Arrays.fill(frame, (byte) letter);
        return frame;
    }

    private static String text(char letter) {
        return new String(frame(letter), ScriptedNetwork.UTF_8);
    }
}
