package org.raspilot.up.wire;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.util.List;
import java.util.Map;
import org.junit.Test;

public final class OrientationFrameTest {
    @Test
    public void goldenFramesAreWritten() throws Exception {
        int written = 0;
        for (Map<String, Object> vector : Vectors.read("orientation_forward.json")) {
            if (vector.get("values") != null) {
                float[] v = new float[6];
                int i = 0;
                for (Object value : (List<?>) vector.get("values")) {
                    v[i++] = ((Number) value).floatValue();
                }
                OrientationFrame frame = new OrientationFrame(v[0], v[1], v[2], v[3], v[4], v[5]);
                assertTrue(frame.isInRange());
                StringBuilder hex = new StringBuilder();
                for (byte each : frame.toBytes()) {
                    hex.append(String.format("%02x", each));
                }
                assertEquals(vector.get("wire"), hex.toString());
                written++;
            }
        }
        assertTrue(written >= 2);
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
                assertFalse(new OrientationFrame(v[0], v[1], v[2], v[3], v[4], v[5]).isInRange());
            }
        }
    }
}
