package org.raspilot.up.security;

import java.nio.ByteBuffer;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import org.raspilot.up.wire.BinaryLine;

/**
 * The aircraft's reply to a hello, an answer or a refusal, not authenticated before {@link #check}.
 *
 * <p>Source: docs/security.md, "Construction". Immutable.
 */
public final class Handshake {
    static final int NONCE_BYTES = 16;
    static final int KEY_ID_BYTES = 8;
    static final int HELLO = 1;
    static final int ANSWER = 2;
    static final int REFUSAL = 3;
    static final List<String> LABELS =
            Collections.unmodifiableList(Arrays.asList("", "hello", "answer", "refusal"));

    private static final List<String> ROLES =
            Arrays.asList("observer", "operator", "pilot", "admin");
    private static final List<String> REFUSALS =
            Arrays.asList("unknown_key", "revoked", "expired", "changed",
                    "secrecy_required");
    private static final byte[] SALT = Hmac.ascii("up handshake 1");
    private static final int WRAPPED_BYTES = 32;
    private static final int ANSWER_BYTES = 123;
    private static final int REFUSAL_BYTES = 43;

    /** Why the key is refused, {@code unknown_key revoked expired changed}; null: an answer. */
    public final String refusal;
    /** The role of the key; null: a refusal. */
    public final String role;
    /** The clock that telemetry reports as {@code system.clock_ms}. */
    public final long clockMs;
    final byte[] keyId = new byte[KEY_ID_BYTES];
    final byte[] groundNonce = new byte[NONCE_BYTES];
    final byte[] nonce = new byte[NONCE_BYTES];
    final byte[] wrapped = new byte[WRAPPED_BYTES];
    final int session;
    final int broadcast;
    final long frameCounter;
    final long messageCounter;
    private final byte[] body;

    private Handshake(byte[] body) throws EnvelopeException {
        this.body = body;
        final int kind = body.length < 2 ? 0 : body[1];
        if (body.length != (kind == ANSWER ? ANSWER_BYTES : kind == REFUSAL ? REFUSAL_BYTES : -1)) {
            throw new EnvelopeException("malformed");
        }
        final ByteBuffer fields = ByteBuffer.wrap(body, 2, body.length - 2);
        fields.get(keyId).get(groundNonce);
        if (kind == REFUSAL) {
            refusal = word(REFUSALS, fields.get());
            role = null;
            session = 0;
            broadcast = 0;
            frameCounter = 0;
            messageCounter = 0;
            clockMs = 0;
            return;
        }
        refusal = null;
        fields.get(nonce);
        role = word(ROLES, fields.get());
        session = fields.getInt();
        broadcast = fields.getInt();
        frameCounter = fields.getLong();
        messageCounter = fields.getLong();
        clockMs = fields.getLong();
        fields.get(wrapped);
    }

    /** Reads a body; throws EnvelopeException: malformed. */
    static Handshake read(byte[] body) throws EnvelopeException {
        return new Handshake(body);
    }

    static byte[] hello(byte[] aircraft, byte[] keyId, byte[] secret, byte[] nonce) {
        return sealed(HELLO, aircraft, secret, ByteBuffer.allocate(KEY_ID_BYTES + NONCE_BYTES)
                .put(keyId).put(nonce).array());
    }

    /** Returns a body of that kind with its MAC at the end. */
    static byte[] sealed(int kind, byte[] aircraft, byte[] secret, byte[] fields) {
        final byte[] body = ByteBuffer.allocate(2 + fields.length).put(BinaryLine.HANDSHAKE)
                .put((byte) kind).put(fields).array();
        return ByteBuffer.allocate(body.length + Hmac.MAC_BYTES).put(body)
                .put(mac(kind, aircraft, secret, body)).array();
    }

    /** Throws EnvelopeException, forged, if another secret or another aircraft wrote it. */
    void check(byte[] aircraft, byte[] secret) throws EnvelopeException {
        final int end = body.length - Hmac.MAC_BYTES;
        Hmac.check(Arrays.copyOfRange(body, end, body.length),
                mac(body[1], aircraft, secret, Arrays.copyOf(body, end)));
    }

    private static byte[] mac(int kind, byte[] aircraft, byte[] secret, byte[] body) {
        final byte[] label = Hmac.ascii(LABELS.get(kind));
        final byte[] key = Hmac.expand(Hmac.extract(SALT, secret), label, aircraft);
        return Hmac.mac(key, label, aircraft, body);
    }

    private static String word(List<String> words, byte at) throws EnvelopeException {
        if (at < 0 || at >= words.size()) {
            throw new EnvelopeException("malformed");
        }
        return words.get(at);
    }
}
