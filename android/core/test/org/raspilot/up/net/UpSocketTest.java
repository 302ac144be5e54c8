package org.raspilot.up.net;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.util.Arrays;
import java.util.Random;
import org.junit.After;
import org.junit.Test;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Faults;
import org.raspilot.up.loop.ManualLoop;
import org.raspilot.up.loop.ScriptedNetwork;
import org.raspilot.up.net.EndpointDiscovery.DiscoveryListener;

/** When an UpSocket connects, gives up and tries again. */
public final class UpSocketTest {
    private static final Endpoint PLACE = new Endpoint("192.0.2.7", 50001, 50000);

    private final Faults faults = new Faults();
    private final ScriptedNetwork network = new ScriptedNetwork();
    private final ManualLoop loop = new ManualLoop(network, faults);
    private final Diary diary = new Diary();
    private final UpSocket socket = socket(new FixedEndpoint(PLACE), diary);

    @After
    public void nothingWasThrown() {
        faults.mustBeNone();
    }

    @Test
    public void itGoesToTheGeneralPortOfItsPlace() {
        assertEquals("not started", socket.status().sentence);
        socket.start();
        socket.start();
        assertEquals(1, network.connections.size());
        assertEquals("192.0.2.7", network.newest().host);
        assertEquals(50001, network.newest().port);
        assertEquals(2000, network.newest().timeoutMs);
        assertEquals("connecting to 192.0.2.7:50001", socket.status().sentence);
        network.newest().accept();
        assertTrue(socket.isConnected());
        assertEquals("connected to 192.0.2.7:50001", socket.status().sentence);
        assertEquals(PLACE, socket.status().endpoint);
        assertEquals(Arrays.asList("connected"), diary.told);
        assertEquals(1, socket.connects());
    }

    @Test
    public void aRawSocketGoesToTheOrientationPort() {
        new UpSocket(loop, new FixedEndpoint(PLACE), diary, UpSocketSettings.raw(), new Random(1))
                .start();
        assertEquals(50000, network.newest().port);
    }

    @Test
    public void theWaitsDoubleFromHalfASecondToTwoEachVariedByAFifth() {
        socket.start();
        final int[] wantedMs = {500, 1000, 2000, 2000, 2000};
        final long[] gotMs = new long[wantedMs.length];
        for (int i = 0; i < wantedMs.length; i++) {
            gotMs[i] = msToNextAttempt("refused");
            assertTrue(i + ": " + gotMs[i], Math.abs(gotMs[i] - wantedMs[i]) <= wantedMs[i] / 5);
        }
        assertTrue("no jitter", gotMs[2] != gotMs[3] || gotMs[3] != gotMs[4]);
        assertTrue(diary.told.isEmpty());
    }

    @Test
    public void theSameSeedWaitsTheSame() {
        final UpSocket twin = socket(new FixedEndpoint(PLACE), diary);
        twin.start();
        final long firstMs = msToNextAttempt("refused");
        twin.stop();
        socket.start();
        assertEquals(firstMs, msToNextAttempt("refused"));
    }

    @Test
    public void anAttemptThatTookLongWaitsNoLongerThanTheShortestAfterwards() {
        socket.start();
        for (int i = 0; i < 5; i++) {
            loop.advance(2000);
            final long waitMs = msToNextAttempt("no answer");
            assertTrue("waited " + waitMs, waitMs <= 600);
        }
    }

    @Test
    public void theStatusSaysWhyItIsNotConnected() {
        socket.start();
        network.newest().end("Connection refused");
        assertEquals("closed", socket.status().code);
        assertEquals(UpSocketStatus.State.WAITING, socket.status().state);
        assertTrue(socket.status().sentence.startsWith("Connection refused; "));
        assertEquals(0, diary.statuses);
        loop.advance(0);
        assertTrue(diary.statuses > 0);
    }

    @Test
    public void aConnectionThatLivedIsComeBackToSoon() {
        socket.start();
        for (int i = 0; i < 4; i++) {
            network.newest().accept();
            loop.advance(2000);
            final long waitMs = msToNextAttempt("broke");
            assertTrue("waited " + waitMs, waitMs >= 400 && waitMs <= 600);
        }
        assertEquals(Arrays.asList("connected", "lost: broke"), diary.told.subList(0, 2));
    }

    @Test
    public void aPeerThatHangsUpAtOnceIsAskedMoreAndMoreSeldom() {
        socket.start();
        long waitMs = 0;
        for (int i = 0; i < 4; i++) {
            network.newest().accept();
            waitMs = msToNextAttempt("closed");
        }
        assertTrue("waited " + waitMs, waitMs >= 1600);
    }

    @Test
    public void thePhonesNetworkCameBack() {
        socket.start();
        network.newest().end("refused");
        loop.advance(10);
        socket.reconnectNow();
        assertEquals(2, network.connections.size());
        socket.reconnectNow();
        assertEquals(2, network.connections.size());
        loop.advance(500);
        socket.reconnectNow();
        assertTrue(network.connections.get(1).isClosed);
        assertEquals(3, network.connections.size());
        network.newest().accept();
        loop.advance(5000);
        socket.reconnectNow();
        assertEquals(3, network.connections.size());
        socket.stop();
        socket.reconnectNow();
        loop.advance(60000);
        assertEquals(3, network.connections.size());
    }

    @Test
    public void reconnectNowBeginsWithTheShortestWaitAgain() {
        socket.start();
        for (int i = 0; i < 4; i++) {
            msToNextAttempt("refused");
        }
        network.newest().end("refused");
        socket.reconnectNow();
        final long waitMs = msToNextAttempt("refused");
        assertTrue("waited " + waitMs, waitMs <= 600);
    }

    @Test
    public void itsOwnerMayDropAConnectionOrAnAttempt() {
        socket.drop("dropped", "not started");
        socket.start();
        socket.drop("dropped", "the network changed");
        assertTrue(network.newest().isClosed);
        assertTrue(diary.told.isEmpty());
        loop.advance(600);
        network.newest().accept();
        socket.drop("dropped", "no answer to the hello");
        assertTrue(network.newest().isClosed);
        assertEquals(Arrays.asList("connected", "lost: no answer to the hello"), diary.told);
        loop.advance(1200);
        assertEquals(3, network.connections.size());
    }

    @Test
    public void stopEndsWhateverIsUnderWay() {
        socket.start();
        socket.stop();
        assertTrue("connecting", network.newest().isClosed);
        assertTrue(diary.told.isEmpty());
        socket.start();
        network.newest().accept();
        socket.stop();
        assertTrue("connected", network.newest().isClosed);
        assertEquals(Arrays.asList("connected", "lost: stopped"), diary.told);
        socket.start();
        network.newest().end("refused");
        socket.stop();
        loop.advance(60000);
        assertEquals(UpSocketStatus.State.STOPPED, socket.status().state);
        assertEquals("stopped", socket.status().sentence);
        assertEquals("waiting", 3, network.connections.size());
        assertEquals(0, loop.pendingTimers());
    }

    @Test
    public void theFinderIsAskedAnewBeforeEachAttempt() {
        final Finder discovery = new Finder();
        final UpSocket moving = socket(discovery, diary);
        moving.start();
        assertEquals(UpSocketStatus.State.FINDING, moving.status().state);
        discovery.listener.onFound(PLACE);
        network.newest().end("refused");
        loop.advance(600);
        assertEquals(2, discovery.asked);
        discovery.listener.onFound(new Endpoint("192.0.2.8", 1, 2));
        assertEquals("192.0.2.8", network.newest().host);
        moving.stop();
    }

    @Test
    public void aPlaceThatIsNotFoundIsLookedForAgain() {
        final Finder discovery = new Finder();
        final UpSocket lost = socket(discovery, diary);
        lost.start();
        discovery.listener.onNotFound("not_found", "no answer from Discovery");
        assertEquals("not_found", lost.status().code);
        assertNull(lost.status().endpoint);
        loop.advance(600);
        assertEquals(2, discovery.asked);
        lost.stop();
        assertTrue(discovery.isCancelled);
        discovery.listener.onFound(PLACE);
        assertTrue("too late", network.connections.isEmpty());
    }

    @Test
    public void aFinderThatThrowsIsAskedAgain() {
        final int[] asked = new int[1];
        final UpSocket unlucky = socket(listener -> {
            asked[0]++;
            throw new IllegalStateException("a finder");
        }, diary);
        loop.post(() -> unlucky.start());
        loop.advance(600);
        assertEquals(2, asked[0]);
        assertEquals("search_failed", unlucky.status().code);
        unlucky.stop();
        assertEquals(2, faults.takeAll().size());
    }

    @Test
    public void itsListenerMayStopItAnywhere() {
        final UpSocket[] shy = new UpSocket[1];
        final Diary stopper = new Diary() {
            @Override
            public void onReceived(byte[] bytes, int length) {
                super.onReceived(bytes, length);
                shy[0].stop();
            }

            @Override
            public void onLost(String reason) {
                super.onLost(reason);
                shy[0].stop();
            }
        };
        shy[0] = socket(new FixedEndpoint(PLACE), stopper);
        shy[0].start();
        network.newest().accept();
        network.newest().say("one\ntwo\n");
        assertEquals(Arrays.asList("connected", "< one", "lost: stopped"), stopper.told);
        shy[0].start();
        network.newest().accept();
        network.newest().end("broke");
        loop.advance(60000);
        assertEquals(UpSocketStatus.State.STOPPED, shy[0].status().state);
        assertEquals(2, network.connections.size());
    }

    /** Ends the newest attempt or connection and returns the wait before the next one. */
    private long msToNextAttempt(String reason) {
        final int count = network.connections.size();
        network.newest().end(reason);
        long waitedMs = 0;
        while (network.connections.size() == count) {
            loop.advance(1);
            waitedMs++;
            assertTrue(waitedMs < 10000);
        }
        return waitedMs;
    }

    private UpSocket socket(EndpointDiscovery discovery, UpSocketListener listener) {
        return new UpSocket(loop, discovery, listener, UpSocketSettings.lines(), new Random(6));
    }

    /** A finder that answers on the test's request. */
    private static final class Finder implements EndpointDiscovery, Cancellable {
        private DiscoveryListener listener;
        private int asked;
        private boolean isCancelled;

        @Override
        public Cancellable find(DiscoveryListener asker) {
            asked++;
            listener = asker;
            return this;
        }

        @Override
        public void cancel() {
            isCancelled = true;
        }
    }
}
