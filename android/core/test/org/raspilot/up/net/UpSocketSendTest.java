package org.raspilot.up.net;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.nio.charset.Charset;
import java.util.Arrays;
import java.util.Random;
import org.junit.After;
import org.junit.Before;
import org.junit.Test;
import org.raspilot.up.loop.Faults;
import org.raspilot.up.loop.ManualLoop;
import org.raspilot.up.loop.ScriptedNetwork;

/** Data that an UpSocket sends and receives, and that it never carries over to a new connection. */
public final class UpSocketSendTest {
    private final Faults faults = new Faults();
    private final ScriptedNetwork network = new ScriptedNetwork();
    private final ManualLoop loop = new ManualLoop(network, faults);
    private final Diary diary = new Diary();
    private final UpSocket socket = socket(UpSocketSettings.lines());

    @Before
    public void connect() {
        socket.start();
        network.newest().accept();
    }

    @After
    public void nothingWasThrown() {
        faults.mustBeNone();
    }

    @Test
    public void linesGoAtOnceAndEachGetsItsEnd() {
        assertTrue(send("one"));
        assertTrue(send("two\n"));
        assertTrue(newest("k", "three"));
        assertEquals("one\ntwo\nthree\n", network.newest().written());
    }

    @Test
    public void whatWaitsUnderAKeyIsReplacedByTheNewest() {
        network.newest().room = 0;
        for (int i = 0; i < 1000; i++) {
            assertTrue(newest("location", "location " + i));
            assertTrue(newest("battery", "battery " + i));
        }
        assertTrue(send("ack"));
        network.newest().makeRoom(1000);
        assertEquals("ack\nlocation 999\nbattery 999\n", network.newest().written());
    }

    @Test
    public void aLineThatWasBegunIsFinishedBeforeAnother() {
        network.newest().room = 4;
        newest("location", "location 1");
        newest("location", "location 2");
        newest("location", "location 3");
        send("ack");
        assertEquals("loca", network.newest().written());
        network.newest().makeRoom(3);
        assertEquals("tio", network.newest().written());
        network.newest().makeRoom(1000);
        assertEquals("n 1\nack\nlocation 3\n", network.newest().written());
    }

    @Test
    public void whatWaitsInOrderIsBounded() {
        network.newest().room = 0;
        final byte[] line = new byte[1024];
        Arrays.fill(line, (byte) 'x');
        line[1023] = '\n';
        int taken = 0;
        while (socket.send(line)) {
            taken++;
        }
        assertEquals(64, taken);
        int newest = 0;
        while (socket.sendNewest(newest, line)) {
            newest++;
        }
        assertEquals(64, newest);
        network.newest().makeRoom(1000000);
        assertEquals(2 * 65536, network.newest().written().length());
    }

    @Test
    public void nothingIsKeptForLater() {
        network.newest().room = 5;
        send("half a line");
        send("another");
        newest("location", "location");
        network.newest().end("broke");
        assertFalse(send("away"));
        assertFalse(newest("location", "away"));
        loop.advance(600);
        assertFalse(send("too early"));
        network.newest().accept();
        assertEquals("", network.newest().written());
        send("new");
        assertEquals("new\n", network.newest().written());
    }

    @Test
    public void halfALineOfAnOldConnectionIsDropped() {
        network.newest().say("whole\r\n\n{\"name\": \"up.arm\",");
        network.newest().end("broke");
        loop.advance(600);
        network.newest().accept();
        network.newest().say(" \"data\": {}}\nwhole again\n");
        assertEquals(Arrays.asList("connected", "< whole", "lost: broke", "connected",
                "<  \"data\": {}}", "< whole again"), diary.told);
    }

    @Test
    public void linesThatAreTooLongAreNeitherSentNorTaken() {
        final char[] letters = new char[16384];
        Arrays.fill(letters, 'x');
        final String long16k = new String(letters);
        assertFalse(send(long16k));
        assertTrue(send(long16k.substring(1)));
        assertEquals(16384, network.newest().written().length());
        network.newest().say(long16k + "\nnext\n");
        assertEquals(Arrays.asList("connected", "< next"), diary.told);
    }

    @Test
    public void whatItsListenerSendsWhenConnectedGoesFirst() {
        final UpSocket[] polite = new UpSocket[1];
        polite[0] = new UpSocket(loop, new FixedEndpoint(new Endpoint("a", 1, 2)),
                new Diary() {
                    @Override
                    public void onConnected() {
                        assertTrue(polite[0].isConnected());
                        assertTrue(polite[0].send(bytes("UP1 aircraft=default")));
                    }
                }, UpSocketSettings.lines().withHeartbeatMs(1000), new Random(1));
        polite[0].start();
        network.newest().accept();
        polite[0].send(bytes("next"));
        assertEquals("UP1 aircraft=default\nnext\n", network.newest().written());
    }

    @Test
    public void aLineAtWhichTheListenerThrowsKeepsNoOtherBack() {
        final UpSocket clumsy = new UpSocket(loop, new FixedEndpoint(new Endpoint("a", 1, 2)),
                new Diary() {
                    @Override
                    public void onReceived(byte[] line, int length) {
                        diary.onReceived(line, length);
                        if (line[0] == 'b') {
                            throw new IllegalStateException("bad line");
                        }
                    }
                }, UpSocketSettings.lines(), new Random(1));
        clumsy.start();
        network.newest().accept();
        loop.post(() -> network.newest().say("bad\ngood\nbad\nwell\n"));
        loop.advance(0);
        assertEquals(Arrays.asList("connected", "< bad", "< good", "< bad", "< well"),
                diary.told);
        assertEquals(2, faults.takeAll().size());
    }

    @Test
    public void rawFramesAreNeitherCutNorEnded() {
        final UpSocket raw = socket(UpSocketSettings.raw());
        raw.start();
        network.newest().accept();
        network.newest().room = 2;
        final byte[] frame = {'a', 'b', '\n', 'd'};
        assertTrue(raw.sendNewest("o", frame));
        Arrays.fill(frame, (byte) 'z');
        assertTrue(raw.sendNewest("o", frame));
        network.newest().makeRoom(100);
        assertEquals("ab\ndzzzz", network.newest().written());
        assertFalse(raw.send(new byte[0]));
        network.newest().say("a\nb");
        assertEquals(Arrays.asList("connected", "connected", "< a\nb"), diary.told);
    }

    private boolean send(String line) {
        return socket.send(bytes(line));
    }

    private boolean newest(String key, String line) {
        return socket.sendNewest(key, bytes(line));
    }

    private UpSocket socket(UpSocketSettings settings) {
        return new UpSocket(loop, new FixedEndpoint(new Endpoint("192.0.2.7", 50001, 50000)), diary,
                settings, new Random(6));
    }

    private static byte[] bytes(String text) {
        return text.getBytes(Charset.forName("UTF-8"));
    }
}
