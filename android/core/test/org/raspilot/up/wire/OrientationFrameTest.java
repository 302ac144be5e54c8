package org.raspilot.up.wire;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.math.BigInteger;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.Random;
import org.junit.Test;

public final class OrientationFrameTest {
    private static final long SEED = 24L;

    @Test
    public void goldenFramesAreReadAndWritten() throws Exception {
        List<Map<String, Object>> vectors = Vectors.read("orientation_forward.json");
        assertTrue(vectors.size() >= 6);
        for (Map<String, Object> vector : vectors) {
            byte[] wire = bytes((String) vector.get("wire"));
            OrientationFrame frame = OrientationFrame.read(wire, 0, wire.length);
            if (vector.get("values") == null) {
                assertNull(frame);
            } else {
                float[] wanted = new float[6];
                int i = 0;
                for (Object value : (List<?>) vector.get("values")) {
                    wanted[i++] = ((Number) value).floatValue();
                }
                assertArrayEquals(wanted, values(frame), 0f);
                assertArrayEquals(wire, new OrientationFrame(wanted[0], wanted[1], wanted[2],
                        wanted[3], wanted[4], wanted[5]).toBytes());
            }
        }
    }

    @Test
    public void aDatagramOfAnotherSizeIsDropped() {
        byte[] wire = new OrientationFrame(1, 2, 3, 4, 5, 6).toBytes();
        assertNull(OrientationFrame.read(wire, 0, 23));
        assertNull(OrientationFrame.read(new byte[25], 0, 25));
        assertNull(OrientationFrame.read(new byte[0], 0, 0));
        byte[] shifted = new byte[30];
        System.arraycopy(wire, 0, shifted, 3, wire.length);
        assertArrayEquals(new float[] {1, 2, 3, 4, 5, 6},
                values(OrientationFrame.read(shifted, 3, 24)), 0f);
    }

    @Test
    public void limitsAreTheLastThatPass() {
        assertTrue(new OrientationFrame(-360, 360, 360, 4000, -4000, 4000).isInRange());
        float beyondAngle = Math.nextUp(360f);
        float beyondRate = Math.nextUp(4000f);
        for (int i = 0; i < 6; i++) {
            for (float wrong : new float[] {Float.NaN, Float.NEGATIVE_INFINITY,
                i < 3 ? beyondAngle : beyondRate, i < 3 ? -beyondAngle : -beyondRate}) {
                float[] v = new float[6];
                v[i] = wrong;
                assertTrue(!new OrientationFrame(v[0], v[1], v[2], v[3], v[4], v[5]).isInRange());
            }
        }
    }

    @Test
    public void aStreamIsCutEverywhereAlike() {
        System.out.println("seed " + SEED);
        Random random = new Random(SEED);
        byte[] stream = new byte[24 * 200];
        for (int i = 0; i < 200; i++) {
            // Every seventh frame is out of range.
            float roll = i % 7 == 0 ? 400f : i;
            System.arraycopy(new OrientationFrame(roll, 0, 0, 0, 0, 0).toBytes(), 0, stream,
                    24 * i, 24);
        }
        for (int run = 0; run < 50; run++) {
            OrientationDecoder decoder = new OrientationDecoder();
            int frames = 0;
            int at = 0;
            while (at < stream.length) {
                int to = Math.min(stream.length, at + 1 + random.nextInt(80));
                for (OrientationFrame frame : decoder.feed(Arrays.copyOfRange(stream, at, to),
                        to - at)) {
                    assertTrue(frame.rollDeg % 7 != 0);
                    frames++;
                }
                at = to;
            }
            assertEquals(29, decoder.dropped());
            assertEquals(171, frames);
        }
    }

    @Test
    public void anUnfinishedFrameDiesWithItsConnection() {
        OrientationDecoder decoder = new OrientationDecoder();
        byte[] wire = new OrientationFrame(1, 2, 3, 4, 5, 6).toBytes();
        assertEquals(0, decoder.feed(wire, 23).size());
        decoder.reset();
        List<OrientationFrame> frames =
                decoder.feed(new OrientationFrame(7, 8, 9, 10, 11, 12).toBytes(), 24);
        assertEquals(1, frames.size());
        assertArrayEquals(new float[] {7, 8, 9, 10, 11, 12}, values(frames.get(0)), 0f);
    }

    private static float[] values(OrientationFrame frame) {
        return new float[] {frame.rollDeg, frame.pitchDeg, frame.yawDeg,
            frame.rollRateDegS, frame.pitchRateDegS, frame.yawRateDegS};
    }

    private static byte[] bytes(String hex) {
        // A leading one keeps leading zeros.
        byte[] marked = new BigInteger("1" + hex, 16).toByteArray();
        return Arrays.copyOfRange(marked, marked.length - hex.length() / 2, marked.length);
    }
}
