package org.raspilot.up.security;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNotNull;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertThrows;

import java.io.File;
import java.math.BigInteger;
import java.util.Arrays;
import java.util.Map;
import java.util.Random;
import org.junit.Test;
import org.raspilot.up.wire.BinaryLine;
import org.raspilot.up.wire.Json;
import org.raspilot.up.wire.Vectors;

/** Envelope and handshake: golden vectors, and messages that must not be accepted. */
public final class GroundSessionTest {
    private static final String ATTITUDE = "01031d810712050301f4ff85002d0e0ffe";

    private final Pairing pairing = of("glider-1");
    private final TestAircraft air = new TestAircraft(pairing);
    private final GroundSession ground = new GroundSession("glider-1", pairing, drawn());

    private static Pairing of(String aircraft) {
        return Pairing.parse(TestAircraft.TEXT.replace(":glider:", ":" + aircraft + ":"));
    }

    /** The golden vectors' random bytes: 0x11, 0x12, ... repeated. */
    private static Random drawn() {
        return new Random() {
            private static final long serialVersionUID = 1L;
            private byte value = 0x10;

            @Override
            public void nextBytes(byte[] bytes) {
                value++;
                Arrays.fill(bytes, value);
            }
        };
    }

    private Handshake begin() throws EnvelopeException {
        return ground.onHandshake(air.answer(ground.hello()));
    }

    private void refused(String code, byte[] body) {
        assertEquals(code, assertThrows(EnvelopeException.class, () -> ground.open(body)).code);
    }

    private void refusedReply(String code, byte[] body) {
        assertEquals(code,
                assertThrows(EnvelopeException.class, () -> ground.onHandshake(body)).code);
    }

    private static String hexadecimal(byte[] bytes) {
        final StringBuilder text = new StringBuilder();
        for (byte each : bytes) {
            text.append(String.format("%02x", each));
        }
        return text.toString();
    }

    @Test
    public void theGoldenVectors() throws Exception {
        final Map<?, ?> file = (Map<?, ?>) Json.parse(
                Vectors.text(new File(System.getProperty("vectors"), "envelope.json")));
        final Map<?, ?> wanted = (Map<?, ?>) file.get("session");
        final byte[] hello = ground.hello();
        final byte[] answer = air.answer(hello);
        final Handshake said = ground.onHandshake(answer);
        final byte[] command = ground.seal(Vectors.bytes("{\"name\":\"up.arm\"}"));
        assertEquals(wanted.get("hello"), hexadecimal(hello));
        assertEquals(wanted.get("answer"), hexadecimal(answer));
        assertEquals("pilot", said.role);
        assertEquals(123456, said.clockMs);
        assertEquals(wanted.get("command"), hexadecimal(command));
        assertEquals(wanted.get("ack"), hexadecimal(air.reply("{\"name\":\"up.ack\"}")));
        assertEquals(wanted.get("telemetry"),
                hexadecimal(air.frame("{\"name\":\"up.telemetry.update\"}")));
        final byte[] attitude = new BigInteger(ATTITUDE, 16).toByteArray();
        final byte[] sealed = air.frame(attitude);
        final byte[] brief = Arrays.copyOfRange(sealed, 11, sealed.length);
        brief[0] = BinaryLine.SHORT;
        assertEquals(wanted.get("attitude"), hexadecimal(brief));
        assertArrayEquals(attitude, ground.open(brief));
        refused("forged", brief);
        assertEquals(wanted.get("message"),
                hexadecimal(air.message("{\"name\":\"up.system.state\"}")));
        assertEquals(wanted.get("refusal"), hexadecimal(air.refuse(0)));
        assertEquals(wanted.get("line"), hexadecimal(BinaryLine.toLine(command)));
    }

    @Test
    public void hkdfIsThatOfRfc5869() throws Exception {
        final byte[] salt = new byte[13];
        for (int at = 0; at < salt.length; at++) {
            salt[at] = (byte) at;
        }
        final byte[] secret = new byte[22];
        Arrays.fill(secret, (byte) 0x0b);
        final byte[] root = Hmac.extract(salt, secret);
        assertEquals("077709362c2e32df0ddc3f0dc47bba6390b6c73bb50f9c3122ec844ad7c2b3e5",
                hexadecimal(root));
        final Map<?, ?> file = (Map<?, ?>) Json.parse(
                Vectors.text(new File(System.getProperty("vectors"), "envelope.json")));
        assertEquals(file.get("expand_of_nothing"), hexadecimal(Hmac.expand(root)));
    }

    @Test
    public void noChangedByteOfTheAircraftsMessagesIsAccepted() throws Exception {
        begin();
        for (byte[] body : new byte[][] {air.frame("{}"), air.message("{}"), air.reply("{}")}) {
            for (int at = 0; at < body.length; at++) {
                final byte[] changed = body.clone();
                changed[at] ^= 1;
                try {
                    assertNull("byte " + at, ground.open(changed));
                } catch (EnvelopeException refused) {
                    assertNotNull(refused.code);
                }
            }
            assertEquals("{}", Vectors.text(ground.open(body)));
        }
        refused("malformed", Arrays.copyOf(air.frame("{}"), 28));
    }

    @Test
    public void noChangedByteOfAReplyIsAccepted() throws Exception {
        final byte[] answer = air.answer(ground.hello());
        for (byte[] body : new byte[][] {air.refuse(1), answer}) {
            for (int at = 0; at < body.length; at++) {
                final byte[] changed = body.clone();
                changed[at] ^= 4;
                try {
                    assertNull("byte " + at, ground.onHandshake(changed));
                } catch (EnvelopeException refused) {
                    assertNotNull(refused.code);
                }
            }
        }
        assertEquals("pilot", ground.onHandshake(answer).role);
    }

    @Test
    public void aMessageIsTakenOnceAndNoneBeforeIt() throws Exception {
        begin();
        final byte[] first = air.frame("1");
        final byte[] second = air.frame("2");
        ground.open(second);
        refused("replayed", second);
        refused("replayed", first);
        begin();
        refused("replayed", second);
    }

    @Test
    public void framesFromBeforeTheHelloAreNotLive() throws Exception {
        final byte[] old = air.frame("{}");
        begin();
        refused("replayed", old);
    }

    @Test
    public void framesTakenBeforeADelayedAnswerAreNotTakenAgain() throws Exception {
        begin();
        final byte[] delayed = air.answer(ground.hello());
        final byte[] frame = air.frame("{}");
        ground.open(frame);
        ground.onHandshake(delayed);
        refused("replayed", frame);
    }

    @Test
    public void itsOwnCommandSentBackIsNoAnswer() throws Exception {
        begin();
        refused("forged", ground.seal(Vectors.bytes("{\"name\":\"up.ack\"}")));
    }

    @Test
    public void aFrameIsNoMessageAndAnAnswerNoFrame() throws Exception {
        begin();
        final byte[] frame = air.frame("{}");
        System.arraycopy(air.message("{}"), 1, frame, 1, 4);
        refused("forged", frame);
    }

    @Test
    public void anotherAircraftWithTheSameKeyIsRefused() throws Exception {
        final byte[] hello = ground.hello();
        final TestAircraft other = new TestAircraft(of("glider-2"));
        assertThrows(AssertionError.class, () -> other.answer(hello));
        final byte[] theirs =
                other.answer(new GroundSession("glider-2", of("glider-2"), drawn()).hello());
        refusedReply("forged", theirs);
    }

    @Test
    public void anAnswerToAnEarlierHelloIsVoid() throws Exception {
        final byte[] late = air.answer(ground.hello());
        ground.forgetHello();
        assertNull(ground.onHandshake(late));
        ground.hello();
        assertNull(ground.onHandshake(late));
    }

    @Test
    public void anAnswerOnTheSessionBeforeIsStillAccepted() throws Exception {
        begin();
        final byte[] late = air.reply("late");
        begin();
        assertEquals("late", Vectors.text(ground.open(late)));
        begin();
        assertNull("of two sessions ago", ground.open(late));
    }

    @Test
    public void whatIsForAnotherGroundIsNoError() throws Exception {
        begin();
        final GroundSession other = new GroundSession(pairing);
        other.onHandshake(air.answer(other.hello()));
        assertNull(ground.open(air.reply("{}")));
    }

    @Test
    public void anAircraftThatRequiresSecrecyIsNamed() throws Exception {
        air.answer(ground.hello());
        assertEquals("secrecy_required", ground.onHandshake(air.refuse(4)).refusal);
    }

    @Test
    public void onlyTheAircraftItselfEndsAnOpenSession() throws Exception {
        begin();
        refusedReply("forged", air.refuseUnknown());
        assertEquals("{}", air.open(ground.seal(Vectors.bytes("{}"))));
        assertEquals("revoked", ground.onHandshake(air.refuse(1)).refusal);
        assertArrayEquals(null, ground.open(air.reply("{}")));
        refused("unknown_stream", air.frame("{}"));
    }

    @Test
    public void anAircraftThatDoesNotKnowTheKeyIsBelievedWhereNothingIsOpen() throws Exception {
        air.answer(ground.hello());
        assertEquals("unknown_key", ground.onHandshake(air.refuseUnknown()).refusal);
    }

    @Test
    public void noncesAreFresh() {
        final byte[] one = new GroundSession(pairing).hello();
        final byte[] other = new GroundSession(pairing).hello();
        assertEquals(false, Arrays.equals(one, other));
    }
}
