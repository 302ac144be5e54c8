package org.raspilot.up.security;

import java.nio.ByteBuffer;
import java.util.Arrays;
import org.raspilot.up.wire.BinaryLine;

/**
 * One direction of one session: its sender seals bodies, its receiver opens them.
 *
 * <p>A body: type, session 4, counter 8, MAC 16, payload. Source: docs/security.md.
 */
final class MessageStream {
    private static final int COUNTER_AT = 5;
    private static final int MAC_AT = 13;
    private static final int SHORT_MAC_AT = 2;
    private static final int PAYLOAD_AT = MAC_AT + Hmac.MAC_BYTES;

    final int session;
    /** The counter of the newest message that was sealed or opened. */
    long counter;
    private final byte[] key;
    private final byte[] direction;
    private final byte[] aircraft;
    private final byte[] keyId;

    MessageStream(byte[] key, String direction, byte[] aircraft, byte[] keyId, int session) {
        this.key = key;
        this.direction = Hmac.ascii(direction);
        this.aircraft = aircraft;
        this.keyId = keyId;
        this.session = session;
    }

    /** Returns the session of a protected body, not authenticated yet. */
    static int sessionOf(byte[] body) throws EnvelopeException {
        if (body.length < PAYLOAD_AT || body[0] != BinaryLine.PROTECTED) {
            throw new EnvelopeException("malformed");
        }
        return ByteBuffer.wrap(body).getInt(1);
    }

    /** Returns the protected body of the next message. */
    byte[] seal(byte[] payload) {
        counter++;
        return ByteBuffer.allocate(PAYLOAD_AT + payload.length).put(BinaryLine.PROTECTED)
                .putInt(session).putLong(counter).put(mac(counter, payload)).put(payload).array();
    }

    /**
     * Returns the protected body of a short one, which has of session and counter only the
     * counter's last byte: the next body whose counter ends so.
     */
    byte[] restored(byte[] body) {
        final int length = Math.max(0, body.length - SHORT_MAC_AT);
        final long next = counter + 1;
        final long number = length == 0 ? next : next + (body[1] - next & 0xff);
        return ByteBuffer.allocate(MAC_AT + length).put(BinaryLine.PROTECTED).putInt(session)
                .putLong(number).put(body, SHORT_MAC_AT, length).array();
    }

    /** Returns the payload; throws EnvelopeException: malformed, forged or replayed. */
    byte[] open(byte[] body) throws EnvelopeException {
        if (sessionOf(body) != session) {
            throw new EnvelopeException("malformed");
        }
        final long number = ByteBuffer.wrap(body).getLong(COUNTER_AT);
        final byte[] payload = Arrays.copyOfRange(body, PAYLOAD_AT, body.length);
        Hmac.check(Arrays.copyOfRange(body, MAC_AT, PAYLOAD_AT), mac(number, payload));
        if (number <= counter) {
            throw new EnvelopeException("replayed");
        }
        counter = number;
        return payload;
    }

    private byte[] mac(long number, byte[] payload) {
        return Hmac.mac(key, direction, aircraft, keyId, Hmac.number(session),
                ByteBuffer.allocate(8).putLong(number).array(), payload);
    }
}
