package org.raspilot.up.security;

import java.nio.ByteBuffer;
import java.util.Arrays;

/** The aircraft's end of a protected link with one paired device; it draws known numbers. */
public final class TestAircraft {
    public static final String TEXT = "upkey:1:glider:0001020304050607:"
            + "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f:pilot:tablet";

    private static final int ROLE_PILOT = 2;

    public long clockMs = 123456;
    private final byte[] aircraft;
    private final byte[] keyId;
    private final byte[] secret;
    private byte drawn = 0x20;
    private byte[] streamKey;
    private MessageStream frames;
    private MessageStream messages;
    private MessageStream commands;
    private MessageStream answers;
    private byte[] groundNonce;

    public TestAircraft(Pairing pairing) {
        aircraft = Hmac.ascii(pairing.aircraft);
        keyId = pairing.keyId();
        secret = pairing.secret();
        restart();
    }

    /** Draws the keys of the streams again. */
    public void restart() {
        streamKey = draw(32);
        final int number = (ByteBuffer.wrap(draw(4)).getInt() | 1 << 31) & ~1;
        final byte[] all = new byte[0];
        frames = new MessageStream(streamKey, "telemetry", aircraft, all, number);
        messages = new MessageStream(streamKey, "message", aircraft, all, number + 1);
    }

    /** Returns the answer to a hello; fails for a hello of another key or aircraft. */
    public byte[] answer(byte[] hello) {
        final byte[] fields = Arrays.copyOfRange(hello, 2, 26);
        if (!Arrays.equals(hello, Handshake.sealed(Handshake.HELLO, aircraft, secret, fields))) {
            throw new AssertionError("a hello of another key");
        }
        groundNonce = Arrays.copyOfRange(fields, 8, 24);
        final byte[] nonce = draw(16);
        final int number = (ByteBuffer.wrap(draw(4)).getInt() & 0x7fffffff) + 1;
        final byte[] salt = ByteBuffer.allocate(32).put(groundNonce).put(nonce).array();
        final byte[] root = Hmac.extract(salt, secret);
        final byte[] wrapped = expand(root, "pad", Hmac.number(number),
                Hmac.number(frames.session));
        for (int at = 0; at < wrapped.length; at++) {
            wrapped[at] ^= streamKey[at];
        }
        commands = stream(root, "command", number);
        answers = stream(root, "answer", number);
        return Handshake.sealed(Handshake.ANSWER, aircraft, secret, ByteBuffer.allocate(105)
                .put(keyId).put(groundNonce).put(nonce).put((byte) ROLE_PILOT).putInt(number)
                .putInt(frames.session).putLong(frames.counter).putLong(messages.counter)
                .putLong(clockMs).put(wrapped).array());
    }

    /** Returns the refusal of the key that sent the newest hello. */
    public byte[] refuse(int reason) {
        return refuse(reason, secret);
    }

    /** Returns the refusal of an aircraft that has no such key: it proves nothing. */
    public byte[] refuseUnknown() {
        return refuse(0, new byte[32]);
    }

    private byte[] refuse(int reason, byte[] proof) {
        return Handshake.sealed(Handshake.REFUSAL, aircraft, proof, ByteBuffer.allocate(25)
                .put(keyId).put(groundNonce).put((byte) reason).array());
    }

    public byte[] frame(String payload) {
        return frames.seal(Hmac.ascii(payload));
    }

    public byte[] frame(byte[] payload) {
        return frames.seal(payload);
    }

    public byte[] message(String payload) {
        return messages.seal(Hmac.ascii(payload));
    }

    public byte[] reply(String payload) {
        return answers.seal(Hmac.ascii(payload));
    }

    /** Returns the payload of a Command. */
    public String open(byte[] body) throws EnvelopeException {
        return new String(commands.open(body));
    }

    private MessageStream stream(byte[] root, String direction, int number) {
        final byte[] key = expand(root, direction, Hmac.number(number));
        return new MessageStream(key, direction, aircraft, keyId, number);
    }

    private byte[] expand(byte[] root, String label, byte[]... numbers) {
        final byte[][] context = new byte[3 + numbers.length][];
        context[0] = Hmac.ascii(label);
        context[1] = aircraft;
        context[2] = keyId;
        System.arraycopy(numbers, 0, context, 3, numbers.length);
        return Hmac.expand(root, context);
    }

    /** The golden vectors' random bytes: 0x21, 0x22, ... repeated. */
    private byte[] draw(int size) {
        final byte[] bytes = new byte[size];
        drawn++;
        Arrays.fill(bytes, drawn);
        return bytes;
    }
}
