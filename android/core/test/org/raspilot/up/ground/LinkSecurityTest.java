package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNotNull;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.io.File;
import java.math.BigInteger;
import java.util.Collections;
import java.util.List;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandCatalogue;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.ground.CommandGate.DisabledReason;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.security.TestAircraft;
import org.raspilot.up.wire.BinaryLine;
import org.raspilot.up.wire.LineSplitter;
import org.raspilot.up.wire.MalformedException;
import org.raspilot.up.wire.ProxyRole;
import org.raspilot.up.wire.Vectors;

/** A ground with a key at a relay that drops, delays, repeats and invents (docs/security.md). */
public final class LinkSecurityTest {
    private static final String PLAIN =
            "{\"name\": \"up.telemetry.update\", \"data\": {}, \"beacon\": 9}";
    private static final long CLOCK_MS = 5000000;

    @Rule
    public final GroundBench bench = new GroundBench();

    private final Pairing pairing = Pairing.parse(TestAircraft.TEXT);
    private final TestAircraft air = new TestAircraft(pairing);
    private long beacon = 100;

    private void connect() {
        bench.start(GroundBench.settings(ProxyRole.COMMAND, false).withPairing(pairing));
        bench.accept(ProxyRole.COMMAND);
        bench.say("UP1 aircraft online");
    }

    /** Opens the link and its session; the answer takes that long. */
    private void open(long tookMs) {
        connect();
        final byte[] hello = hello();
        bench.loop.advance(tookMs / 2);
        air.clockMs = clockMs();
        final byte[] answer = air.answer(hello);
        bench.loop.advance(tookMs - tookMs / 2);
        line(answer);
    }

    private long clockMs() {
        return CLOCK_MS + bench.loop.nowMs();
    }

    private void line(byte[] body) {
        final byte[] line = BinaryLine.toLine(body);
        bench.peer().listener.onBytes(line, line.length);
        bench.loop.advance(0);
    }

    private byte[] frame(String data) {
        return air.frame("{\"name\":\"up.telemetry.update\",\"data\":" + data + ",\"beacon\":"
                + ++beacon + "}");
    }

    private byte[] timedFrame() {
        return frame("{\"system\":{\"clock_ms\":" + clockMs() + "}}");
    }

    /** Returns the newest binary body that the ground wrote since the last call; null: none. */
    private byte[] written(byte type) {
        final byte[] all = bench.peer().writtenBytes();
        byte[] found = null;
        for (byte[] line : new LineSplitter().feed(all, all.length)) {
            try {
                final byte[] body = BinaryLine.toBody(line, line.length);
                assertTrue("plain: " + new String(body), body[0] != '{');
                found = body[0] == type ? body : found;
            } catch (MalformedException fault) {
                throw new AssertionError(fault);
            }
        }
        return found;
    }

    private byte[] hello() {
        final byte[] found = written(BinaryLine.HANDSHAKE);
        assertNotNull(found);
        return found;
    }

    private String command() throws Exception {
        return air.open(written(BinaryLine.PROTECTED));
    }

    @Test
    public void aSessionIsOpenedAndShown() throws Exception {
        connect();
        assertEquals("no_session", bench.status.keyFault);
        line(air.answer(hello()));
        assertEquals("", bench.status.keyFault);
        assertEquals("tablet", bench.status.keyName);
        assertEquals("pilot", bench.status.commandRole);
        assertTrue(bench.status.securityText(), bench.status.securityText().contains("tablet"));
        line(frame("{\"ground\": {\"role\": \"observer\"}}"));
        assertEquals(1, bench.frames.size());
        assertEquals("the role is that of the key", "pilot", bench.ground.status().commandRole);
    }

    @Test
    public void aCommandLeavesSealedAndItsAnswerIsTaken() throws Exception {
        open(0);
        line(frame("{}"));
        final String gains = command();
        assertTrue("a protected request has a beacon", gains.contains("\"beacon\": " + beacon));
        bench.ground.send(new BaseCommand(Commands.ARM), beacon, bench.keeping());
        final String sent = command();
        assertTrue(sent, sent.startsWith("{\"name\": \"up.arm\"") && !sent.endsWith("\n"));
        final String id = (String) GroundBench.json(sent).get("id");
        final String ack = "{\"name\": \"up.ack\", \"data\": {\"id\": \"" + id + "\"}}";
        bench.say(ack);
        assertTrue("a plain answer is the relay's", bench.answers.isEmpty());
        line(air.reply(ack));
        assertEquals(Answer.Outcome.ACK, bench.answer().outcome);
    }

    @Test
    public void plainTelemetryIsRefusedWhereAKeyExists() {
        connect();
        bench.say(PLAIN);
        line(air.answer(hello()));
        bench.say(PLAIN);
        assertTrue(bench.frames.isEmpty());
    }

    @Test
    public void aForgedAndARepeatedFrameAreRefused() {
        open(0);
        final byte[] frame = frame("{}");
        final byte[] forged = frame.clone();
        forged[forged.length - 2] ^= 1;
        line(forged);
        assertTrue(bench.frames.isEmpty());
        line(frame);
        line(frame);
        assertEquals(1, bench.frames.size());
        assertEquals(2, bench.ground.status().refused);
    }

    @Test
    public void withoutASessionNothingIsSent() throws Exception {
        connect();
        final CommandCatalogue catalogue = CommandCatalogue.read(Vectors.text(new File(
                System.getProperty("vectors"), "../../android/raspilot/assets/commands.json")));
        bench.say("UP1 seat holder=1");
        final DisabledReason shown = CommandGate.objection(
                catalogue.form("up.arm"), Collections.emptyMap(), bench.status,
                Telemetry.EMPTY, bench.loop.nowMs());
        assertEquals(DisabledReason.NO_SESSION, shown);
        bench.ground.send(new BaseCommand(Commands.ARM), null, bench.keeping());
        assertEquals("no_session", bench.answer().code);
        assertNull(written(BinaryLine.PROTECTED));
    }

    @Test
    public void anAnswerAfterTwoSecondsIsVoid() {
        connect();
        final byte[] late = air.answer(hello());
        bench.loop.advance(LinkSecurity.ANSWER_MS);
        assertNotNull(hello());
        line(late);
        assertEquals("no_session", bench.status.keyFault);
    }

    @Test
    public void aSessionIsRenewedEachMinuteAndSoonAfterASlowAnswer() {
        open(300);
        fly(LinkSecurity.RENEW_MS - 500);
        assertNull(written(BinaryLine.HANDSHAKE));
        fly(500);
        final byte[] hello = hello();
        bench.loop.advance(301);
        line(air.answer(hello));
        fly(4500);
        assertNull(written(BinaryLine.HANDSHAKE));
        fly(500);
        hello();
    }

    /** Frames arrive each 500 ms for that time. */
    private void fly(long forMs) {
        for (long each = 0; each < forMs; each += 500) {
            bench.loop.advance(500);
            line(frame("{}"));
        }
    }

    @Test
    public void aRevokedKeyEndsTheSessionAndIsShown() {
        open(0);
        line(frame("{}"));
        written(BinaryLine.PROTECTED);
        line(air.refuse(1));
        assertEquals("revoked", bench.status.keyFault);
        bench.ground.send(new BaseCommand(Commands.ARM), beacon, bench.keeping());
        assertEquals("revoked", bench.answer().code);
        assertNull(written(BinaryLine.PROTECTED));
    }

    @Test
    public void theGainsAreRequestedWhenTheSessionOfANewConnectionIsOpen() throws Exception {
        open(0);
        bench.peer().end("lost");
        bench.loop.advance(700);
        bench.accept(ProxyRole.COMMAND);
        final byte[] hello = hello();
        line(frame("{}"));
        assertNull(written(BinaryLine.PROTECTED));
        line(air.answer(hello));
        line(frame("{}"));
        assertTrue(command().contains("arduino.pids.tunings"));
    }

    @Test
    public void aRestartedAircraftGetsAHelloOnceASecond() {
        open(0);
        air.restart();
        line(frame("{}"));
        assertNull("within a second of the last", written(BinaryLine.HANDSHAKE));
        bench.loop.advance(1000);
        line(frame("{}"));
        final byte[] answer = air.answer(hello());
        line(frame("{}"));
        assertNull(written(BinaryLine.HANDSHAKE));
        line(answer);
        assertEquals("no frame from before the hello", 0, bench.frames.size());
        line(frame("{}"));
        assertEquals(1, bench.frames.size());
    }

    @Test
    public void aFrameHeldBackIsLate() {
        open(0);
        line(timedFrame());
        assertFalse(bench.ground.status().isSilent);
        final byte[] held = timedFrame();
        bench.loop.advance(3000);
        line(held);
        assertTrue(bench.ground.status().isLate);
        assertTrue(bench.ground.status().isSilent);
    }

    @Test
    public void aRelayThatDelaysAllFramesFromTheFirstIsSeenByTheClock() {
        open(0);
        final byte[] held = timedFrame();
        bench.loop.advance(3000);
        line(held);
        assertEquals(3000, bench.frames.get(0).age.transitMs);
        assertTrue(bench.ground.status().isLate);
    }

    @Test
    public void aPackedFrameIsReadAndAMissingKeyRequested() throws Exception {
        open(0);
        written(BinaryLine.HANDSHAKE);
        final String first = (String) ((List<?>) Vectors.read("packed_telemetry.json").get(0)
                .get("lines")).get(0);
        line(air.frame(new BigInteger(first, 16).toByteArray()));
        assertEquals(Long.valueOf(7), bench.frames.get(0).beacon);
        bench.peer().written();
        final byte[] keyless = {BinaryLine.PACKED, 1, 2, 3, 4, 5};
        line(air.frame(keyless));
        assertEquals("UP1 key\n", bench.peer().written());
        line(air.frame(keyless));
        assertEquals("", bench.peer().written());
        bench.loop.advance(500);
        line(air.frame(keyless));
        assertEquals("UP1 key\n", bench.peer().written());
    }

    @Test
    public void protectedLinesWithoutAKeyAreToldInWords() {
        bench.open(ProxyRole.LISTEN);
        line(frame("{}"));
        line(air.frame(new byte[] {0}));
        assertEquals(KeyTexts.fault("key_missing"), bench.ground.status().linkText());
        assertEquals("", bench.ground.status().keyFault);
        bench.frame(1, "{}");
        assertEquals(1, bench.frames.size());
        assertEquals("connected", bench.ground.status().linkText());
    }

    @Test
    public void theKeyOfAnotherAircraftIsNotUsed() {
        assertThrows(IllegalArgumentException.class, () -> new GroundSettings("h", 1, "other",
                ProxyRole.LISTEN, false).withPairing(pairing));
    }
}
