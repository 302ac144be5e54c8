package org.raspilot.up.security;

import java.io.DataInputStream;
import java.io.FileInputStream;
import java.io.IOException;
import java.security.SecureRandom;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Random;
import org.raspilot.up.wire.BinaryLine;

/**
 * The end of a protected link in a ground device: sends hellos, checks answers, seals Commands,
 * opens the aircraft's messages.
 *
 * <p>A new session replaces the old one when it is answered; answers on the one before are still
 * accepted. Source: docs/security.md.
 */
public final class GroundSession {
    private static final int SEED_BYTES = 32;

    private final byte[] aircraft;
    private final byte[] keyId;
    private final byte[] secret;
    private final Random random;
    /** That of the last hello; null: an answer is void. */
    private byte[] nonce;
    private byte[] lastNonce;
    private MessageStream commands;
    private MessageStream answers;
    private MessageStream frames;
    private final Map<Integer, MessageStream> streams = new LinkedHashMap<>();

    public GroundSession(Pairing pairing) {
        this(pairing.aircraft, pairing, seeded(new SecureRandom()));
    }

    /** Takes the name in every MAC, and the source of the nonces. */
    GroundSession(String peer, Pairing pairing, Random random) {
        aircraft = Hmac.ascii(peer);
        keyId = pairing.keyId();
        secret = pairing.secret();
        this.random = random;
    }

    /** Returns the body of a hello with a fresh nonce; an answer to an earlier one is void. */
    public byte[] hello() {
        nonce = new byte[Handshake.NONCE_BYTES];
        random.nextBytes(nonce);
        return Handshake.hello(aircraft, keyId, secret, nonce);
    }

    /** Refuses every answer to the last hello. */
    public void forgetHello() {
        nonce = null;
    }

    /** Takes a reply; returns null if it is for another ground or an earlier hello. */
    public Handshake onHandshake(byte[] body) throws EnvelopeException {
        final Handshake said = Handshake.read(body);
        final boolean isToHello = nonce != null && Arrays.equals(said.groundNonce, nonce);
        if (!Arrays.equals(said.keyId, keyId)) {
            return null;
        }
        if (said.refusal != null) {
            final boolean isToSession = lastNonce != null
                    && Arrays.equals(said.groundNonce, lastNonce);
            return isToHello || isToSession ? refused(said) : null;
        }
        if (!isToHello) {
            return null;
        }
        said.check(aircraft, secret);
        open(said);
        return said;
    }

    /** Returns the protected body of a message to the aircraft; needs an open session. */
    public byte[] seal(byte[] payload) {
        return commands.seal(payload);
    }

    /**
     * Returns the payload of a protected body; null: it is for another ground.
     *
     * @throws EnvelopeException unknown_stream: the aircraft has restarted or has drawn a new key
     */
    public byte[] open(byte[] body) throws EnvelopeException {
        if (body[0] == BinaryLine.SHORT) {
            if (frames == null) {
                throw new EnvelopeException("unknown_stream");
            }
            return frames.open(frames.restored(body));
        }
        final int session = MessageStream.sessionOf(body);
        final MessageStream stream = streams.get(session);
        if (stream != null) {
            return stream.open(body);
        }
        if (session < 0) {
            // Bit 31 is set in the streams to all grounds.
            throw new EnvelopeException("unknown_stream");
        }
        return null;
    }

    /** An aircraft that does not know the key cannot prove it; that ends no open session. */
    private Handshake refused(Handshake said) throws EnvelopeException {
        if (commands != null || !said.refusal.equals("unknown_key")) {
            said.check(aircraft, secret);
            commands = null;
            answers = null;
            frames = null;
            streams.clear();
        }
        return said;
    }

    private void open(Handshake said) {
        final byte[] salt = Arrays.copyOf(said.groundNonce, 2 * Handshake.NONCE_BYTES);
        System.arraycopy(said.nonce, 0, salt, Handshake.NONCE_BYTES, Handshake.NONCE_BYTES);
        final byte[] root = Hmac.extract(salt, secret);
        final byte[] session = Hmac.number(said.session);
        final byte[] streamKey = Hmac.expand(root, Hmac.ascii("pad"), aircraft, keyId, session,
                Hmac.number(said.broadcast));
        for (int at = 0; at < streamKey.length; at++) {
            streamKey[at] ^= said.wrapped[at];
        }
        final byte[] all = new byte[0];
        frames = new MessageStream(streamKey, "telemetry", aircraft, all, said.broadcast);
        final MessageStream messages =
                new MessageStream(streamKey, "message", aircraft, all, said.broadcast + 1);
        // Messages from before the hello are not live, and none is taken twice.
        frames.counter = newest(frames, said.frameCounter);
        messages.counter = newest(messages, said.messageCounter);
        final MessageStream before = answers;
        answers = ofSession(root, "answer", said.session);
        commands = ofSession(root, "command", said.session);
        streams.clear();
        if (before != null) {
            streams.put(before.session, before);
        }
        for (MessageStream each : Arrays.asList(answers, frames, messages)) {
            streams.put(each.session, each);
        }
        lastNonce = nonce;
        nonce = null;
    }

    /** Mixes bytes of the kernel in: the generator of Android 4.3 and earlier may repeat itself. */
    static Random seeded(SecureRandom random) {
        final byte[] seed = new byte[SEED_BYTES];
        try {
            final DataInputStream kernel =
                    new DataInputStream(new FileInputStream("/dev/urandom"));
            try {
                kernel.readFully(seed);
            } finally {
                kernel.close();
            }
            random.setSeed(seed);
        } catch (IOException absent) {
            // Not Linux: the system's own seed must do.
            return random;
        }
        return random;
    }

    private long newest(MessageStream stream, long told) {
        final MessageStream known = streams.get(stream.session);
        return known == null ? told : Math.max(told, known.counter);
    }

    private MessageStream ofSession(byte[] root, String direction, int session) {
        final byte[] key = Hmac.expand(root, Hmac.ascii(direction), aircraft, keyId,
                Hmac.number(session));
        return new MessageStream(key, direction, aircraft, keyId, session);
    }
}
