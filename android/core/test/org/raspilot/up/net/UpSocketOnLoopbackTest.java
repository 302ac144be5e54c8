package org.raspilot.up.net;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import java.nio.ByteBuffer;
import java.nio.charset.Charset;
import java.util.Arrays;
import java.util.Random;
import java.util.concurrent.Callable;
import org.junit.After;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.loop.RunningLoop;

/** An UpSocket on a real loop with a real peer. */
public final class UpSocketOnLoopbackTest {
    private static final int FRAME = 24;

    @Rule
    public final RunningLoop running = new RunningLoop();
    @Rule
    public final Peer peer = new Peer();
    private final Diary diary = new Diary();

    @After
    public void nothingWasThrown() {
        running.faults.mustBeNone();
    }

    @Test
    public void itComesBackAfterEachEndOfTheConnection() throws Exception {
        final UpSocket socket = start(peer.place(), quick());
        for (int i = 0; i < 6; i++) {
            peer.accept();
            awaitConnects(socket, i + 1);
            send(socket, "line " + i);
            assertEquals("line " + i, peer.readLine());
            peer.say("answer " + i + "\nhalf");
            awaitTold("< answer " + i);
            if (i % 2 == 0) {
                peer.hangUp();
            } else {
                peer.cut();
            }
        }
        peer.accept();
        awaitConnects(socket, 7);
        peer.say(" a line\n");
        awaitTold("<  a line");
    }

    @Test
    public void aPeerThatDoesNotReadGetsTheNewestLaterAndNoBacklog() throws Exception {
        final UpSocket socket = start(peer.place(), quickRaw());
        peer.accept();
        awaitConnects(socket, 1);
        final int frames = 200000;
        for (int i = 0; i < frames; i += 1000) {
            sendFrames(socket, i, i + 1000);
        }
        long last = -1;
        int read = 0;
        while (last != frames - 1) {
            final byte[] frame = new byte[FRAME];
            peer.in().readFully(frame);
            final long number = ByteBuffer.wrap(frame).getLong();
            assertTrue(number + " after " + last, number > last);
            last = number;
            read++;
        }
        // The system's buffers hold the oldest ones, the queue the newest.
        assertTrue("read " + read, read < 10000);
        assertEquals(1, (long) running.call(() -> socket.connects()));
    }

    @Test
    public void aPeerThatDoesNotReadGetsLinesInOrderUpToTheBound() throws Exception {
        final UpSocket socket = start(peer.place(), quick());
        peer.accept();
        awaitConnects(socket, 1);
        final int taken = running.call(() -> {
            final char[] letters = new char[1000];
            Arrays.fill(letters, 'x');
            int count = 0;
            while (socket.send(bytes(count + " " + new String(letters)))) {
                count++;
            }
            return count;
        });
        for (int i = 0; i < taken; i++) {
            assertTrue(peer.readLine().startsWith(i + " xxx"));
        }
    }

    private static UpSocketSettings quick() {
        return new UpSocketSettings(false, 20000, 0, 0, 1, 4, null);
    }

    private static UpSocketSettings quickRaw() {
        return new UpSocketSettings(true, 20000, 0, 0, 500, 2000, null);
    }

    private UpSocket make(EndpointDiscovery discovery, UpSocketSettings settings) {
        return new UpSocket(running.loop, discovery, diary, settings, new Random(6));
    }

    private UpSocket start(Endpoint place, UpSocketSettings settings) {
        final UpSocket socket = make(new FixedEndpoint(place), settings);
        running.call(start(socket));
        return socket;
    }

    private static Callable<Void> start(final UpSocket socket) {
        return () -> {
            socket.start();
            return null;
        };
    }

    private void send(final UpSocket socket, final String line) {
        assertTrue(running.call(() -> socket.send(bytes(line))));
    }

    private void sendFrames(final UpSocket socket, final int first, final int end) {
        running.call(() -> {
            for (int i = first; i < end; i++) {
                socket.sendNewest("frame", ByteBuffer.allocate(FRAME).putLong(i).array());
            }
            return null;
        });
    }

    private void awaitConnects(final UpSocket socket, final int count) {
        running.await("connection " + count, () ->
                socket.isConnected() && socket.connects() == count);
    }

    private void awaitTold(final String what) {
        running.await(what, () -> diary.told.contains(what));
    }

    private static byte[] bytes(String text) {
        return text.getBytes(Charset.forName("UTF-8"));
    }
}
