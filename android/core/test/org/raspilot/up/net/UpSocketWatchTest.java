package org.raspilot.up.net;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import java.util.Arrays;
import java.util.Random;
import org.junit.After;
import org.junit.Test;
import org.raspilot.up.loop.Faults;
import org.raspilot.up.loop.ManualLoop;
import org.raspilot.up.loop.ScriptedNetwork;

/** The heartbeat of an UpSocket, and when it gives a silent or stalled peer up. */
public final class UpSocketWatchTest {
    private final Faults faults = new Faults();
    private final ScriptedNetwork network = new ScriptedNetwork();
    private final ManualLoop loop = new ManualLoop(network, faults);
    private final Diary diary = new Diary();
    private UpSocket socket;

    @After
    public void nothingWasThrown() {
        faults.mustBeNone();
    }

    @Test
    public void anEmptyLineGoesAfterEachSecondOfOwnSilence() {
        connect(UpSocketSettings.lines().withHeartbeatMs(1000));
        loop.advance(999);
        assertEquals("", network.newest().written());
        loop.advance(1);
        assertEquals("\n", network.newest().written());
        loop.advance(600);
        socket.send(new byte[] {'a'});
        loop.advance(999);
        assertEquals("a\n", network.newest().written());
        loop.advance(1);
        assertEquals("\n", network.newest().written());
        loop.advance(3000);
        assertEquals("\n\n\n", network.newest().written());
    }

    @Test
    public void aHeartbeatBreaksNoLine() {
        connect(new UpSocketSettings(false, 2000, 1000, 0, 500, 2000, null));
        network.newest().room = 2;
        socket.send(new byte[] {'a', 'b', 'c'});
        loop.advance(5000);
        // There is room already, but the loop has not reported it yet.
        network.newest().room = 100;
        loop.advance(1000);
        network.newest().makeRoom(100);
        assertEquals("abc\n", network.newest().written());
        loop.advance(1000);
        assertEquals("\n", network.newest().written());
    }

    @Test
    public void withoutAHeartbeatNothingGoes() {
        connect(UpSocketSettings.lines());
        loop.advance(60000);
        assertEquals("", network.newest().written());
        assertEquals(0, loop.pendingTimers());
    }

    @Test
    public void aPeerThatTakesNothingOfWhatWaitsIsGivenUp() {
        connect(UpSocketSettings.lines());
        loop.advance(10000);
        network.newest().room = 1;
        socket.sendNewest("k", new byte[] {'a'});
        loop.advance(2000);
        network.newest().makeRoom(1);
        assertEquals("a\n", network.newest().written());
        loop.advance(10000);
        assertTrue("nothing waits", socket.isConnected());
        for (int i = 0; i < 29; i++) {
            socket.sendNewest("k", new byte[] {'b'});
            loop.advance(100);
        }
        assertTrue(socket.isConnected());
        loop.advance(100);
        assertEquals("stalled", socket.status().code);
    }

    @Test
    public void aPeerThatTakesLittleIsNotGivenUp() {
        connect(UpSocketSettings.lines());
        network.newest().room = 0;
        socket.send(new byte[20]);
        for (int i = 0; i < 20; i++) {
            loop.advance(2900);
            network.newest().makeRoom(1);
            assertTrue(socket.isConnected());
        }
    }

    @Test
    public void noTimerOutlivesAConnection() {
        connect(UpSocketSettings.lines().withHeartbeatMs(1000));
        network.newest().room = 0;
        socket.send(new byte[] {'a'});
        socket.stop();
        assertEquals(0, loop.pendingTimers());
        loop.advance(60000);
        assertEquals(Arrays.asList("connected", "lost: stopped"), diary.told);
    }

    private void connect(UpSocketSettings settings) {
        socket = new UpSocket(loop, new FixedEndpoint(new Endpoint("192.0.2.7", 50001, 50000)),
                diary,
                settings, new Random(6));
        socket.start();
        network.newest().accept();
        loop.advance(0);
    }
}
