package org.raspilot.up.wire;

import java.nio.ByteBuffer;
import java.util.Arrays;
import java.util.zip.CRC32;
import java.util.zip.DataFormatException;
import java.util.zip.Inflater;

/**
 * Unpacks the frames of one aircraft: raw deflate with an earlier frame, the key, as dictionary.
 * Only the newest key is kept. In place of deflate data there may be an {@link AttitudeFrame}. Source: docs/protocols.md 6.
 */
public final class PackedTelemetry {
    /** Code of a frame whose key was not received here. */
    public static final String UNKNOWN_KEY = "unknown_key";

    private static final int HEAD_BYTES = 4;
    private static final int KEY_FLAG = 1 << 23;
    private static final byte[] DICTIONARY = Utf8.encode(PackedDictionary.TEXT);
    private static final int DICTIONARY_NUMBER = number(DICTIONARY);

    private byte[] key = DICTIONARY;
    private int keyNumber = DICTIONARY_NUMBER;

    /**
     * Returns the frame of a body, less than 16 KiB.
     *
     * @throws MalformedException with the code {@link #UNKNOWN_KEY}, or {@code packed}
     */
    public byte[] unpack(byte[] body) throws MalformedException {
        if (body.length <= HEAD_BYTES || body[0] != BinaryLine.PACKED) {
            throw new MalformedException("packed", "not a packed frame");
        }
        final int head = ByteBuffer.wrap(body).getInt() & 0xffffff;
        final int number = head & ~KEY_FLAG;
        if (number != keyNumber && number != DICTIONARY_NUMBER) {
            throw new MalformedException(UNKNOWN_KEY, "the key of this frame was not received");
        }
        final byte[] dictionary = number == keyNumber ? key : DICTIONARY;
        if (AttitudeFrame.isType(body[HEAD_BYTES])) {
            return AttitudeFrame.expand(dictionary, body, HEAD_BYTES);
        }
        final byte[] frame = inflate(body, dictionary);
        if ((head & KEY_FLAG) != 0) {
            key = frame;
            keyNumber = number(frame);
        }
        return frame;
    }

    private static byte[] inflate(byte[] body, byte[] dictionary) throws MalformedException {
        final Inflater inflater = new Inflater(true);
        final byte[] frame = new byte[LineSplitter.MAX_LINE_BYTES];
        try {
            inflater.setDictionary(dictionary);
            inflater.setInput(body, HEAD_BYTES, body.length - HEAD_BYTES);
            final int length = inflater.inflate(frame);
            if (!inflater.finished() || inflater.getRemaining() > 0 || length == frame.length) {
                throw new MalformedException("packed", "too large, cut off or continued");
            }
            return Arrays.copyOf(frame, length);
        } catch (DataFormatException fault) {
            throw new MalformedException("packed", "not deflate data");
        } finally {
            inflater.end();
        }
    }

    private static int number(byte[] key) {
        final CRC32 sum = new CRC32();
        sum.update(key);
        return (int) sum.getValue() & (KEY_FLAG - 1);
    }
}
