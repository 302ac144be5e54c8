package org.raspilot.up.wire;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.zip.Deflater;
import org.junit.Test;

/** Packed telemetry and binary lines: the same bytes as in Python, and bad ones refused. */
public final class PackedTelemetryTest {
    private final PackedTelemetry unpacker = new PackedTelemetry();

    private static byte[] bytes(String hexadecimal) {
        final byte[] bytes = new byte[hexadecimal.length() / 2];
        for (int at = 0; at < bytes.length; at++) {
            bytes[at] = (byte) Integer.parseInt(
                    hexadecimal.substring(2 * at, 2 * at + 2), 16);
        }
        return bytes;
    }

    /** Returns the body of a frame that is not a key frame, with the common dictionary. */
    private static byte[] packed(byte[] frame) {
        final Deflater deflater = new Deflater(6, true);
        deflater.setDictionary(Utf8.encode(PackedDictionary.TEXT));
        deflater.setInput(frame);
        deflater.finish();
        final byte[] body = new byte[40000];
        body[0] = BinaryLine.PACKED;
        System.arraycopy(bytes("031d81"), 0, body, 1, 3);
        final int length = 4 + deflater.deflate(body, 4, body.length - 4);
        deflater.end();
        return Arrays.copyOf(body, length);
    }

    private void refused(String code, byte[] body) {
        assertEquals(code, assertThrows(MalformedException.class, () ->
                unpacker.unpack(body)).code);
    }

    @Test
    public void theGoldenVectors() throws Exception {
        for (Map<String, Object> vector : Vectors.read("packed_telemetry.json")) {
            final PackedTelemetry each = new PackedTelemetry();
            final List<?> lines = (List<?>) vector.get("lines");
            final List<?> frames = (List<?>) vector.get("frames");
            assertTrue(!lines.isEmpty() && lines.size() == frames.size());
            for (int at = 0; at < lines.size(); at++) {
                final byte[] line = bytes((String) lines.get(at));
                final byte[] frame = each.unpack(BinaryLine.toBody(line, line.length));
                assertEquals(frames.get(at), Vectors.text(frame));
            }
        }
    }

    @Test
    public void aFrameWithoutItsKeyIsRefusedAndTheNextKeyIsTaken() throws Exception {
        final List<?> lines =
                (List<?>) Vectors.read("packed_telemetry.json").get(0).get("lines");
        final byte[] ofKey = bytes((String) lines.get(1));
        refused(PackedTelemetry.UNKNOWN_KEY, ofKey);
        unpacker.unpack(bytes((String) lines.get(0)));
        unpacker.unpack(ofKey);
    }

    @Test
    public void attitudeFramesThatAreNotOneAreRefused() throws Exception {
        final List<?> lines = (List<?>) Vectors.read("packed_telemetry.json").get(3).get("lines");
        final byte[] body = bytes((String) lines.get(1));
        refused(PackedTelemetry.UNKNOWN_KEY, body);
        unpacker.unpack(bytes((String) lines.get(0)));
        unpacker.unpack(body);
        refused("packed", Arrays.copyOf(body, body.length - 1));
        refused("packed", Arrays.copyOf(body, body.length + 1));
        body[4] = 0x0f;
        refused("packed", body);
    }

    @Test
    public void dataThatAreNotOneFrameAreRefused() throws Exception {
        final byte[] whole = packed(Vectors.bytes("{\"name\":\"x\"}"));
        unpacker.unpack(whole);
        refused("packed", Arrays.copyOf(whole, whole.length - 1));
        refused("packed", Arrays.copyOf(whole, whole.length + 1));
        refused("packed", Arrays.copyOf(whole, 4));
        final byte[] noDeflate = Arrays.copyOf(whole, 6);
        noDeflate[4] = (byte) 0xff;
        refused("packed", noDeflate);
    }

    @Test
    public void aBombIsNotInflated() throws Exception {
        assertEquals(16383, unpacker.unpack(packed(new byte[16383])).length);
        refused("packed", packed(new byte[16384]));
        refused("packed", packed(new byte[9999999]));
    }

    @Test
    public void noMutatedFrameEndsInAnotherFault() {
        final Random random = new Random(1);
        final byte[] whole = packed(Vectors.bytes("{\"name\":\"up.telemetry.update\"}"));
        for (int each = 0; each < 3000; each++) {
            final byte[] changed = Arrays.copyOf(whole, 1 + random.nextInt(whole.length));
            changed[random.nextInt(changed.length)] ^= 1 << random.nextInt(8);
            try {
                unpacker.unpack(changed);
            } catch (MalformedException refused) {
                assertTrue(refused.code, refused.code.equals("packed")
                        || refused.code.equals(PackedTelemetry.UNKNOWN_KEY));
            }
        }
    }

    @Test
    public void everyBodyComesBackThroughALine() throws Exception {
        final byte[] body = new byte[257];
        for (int each = 1; each < body.length; each++) {
            body[each] = (byte) (each - 1);
        }
        final LineSplitter splitter = new LineSplitter();
        for (byte type = 1; type <= 4; type++) {
            body[0] = type;
            // The CR at the end of a body is a part of it.
            for (byte[] sent : new byte[][] {body, {type, '\r'}, {type, '\n', 27, 27}}) {
                final byte[] line = BinaryLine.toLine(sent);
                final List<byte[]> lines = splitter.feed(line, line.length);
                assertEquals(1, lines.size());
                assertArrayEquals(sent, BinaryLine.toBody(lines.get(0), lines.get(0).length));
            }
        }
    }

    @Test
    public void aWrongEscapeIsRefusedAndJsonIsABody() throws Exception {
        for (byte[] line : new byte[][] {{1, 27}, {2, 27, 27}, {3, 27, 'x', 0}}) {
            assertThrows(MalformedException.class, () ->
                    BinaryLine.toBody(line, line.length));
        }
        assertArrayEquals(new byte[] {'{', 27}, BinaryLine.toBody(new byte[] {'{', 27, 9}, 2));
    }
}
