package org.raspilot.up.android;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;

import org.junit.Test;

public final class RotationVectorTest {
    private static final double NEAR = 1e-6;

    @Test
    public void fourZerosAreNoRotation() {
        assertNull(RotationVector.read(new float[] {0, 0, 0, 0}, 0, 18));
        assertNull(RotationVector.read(new float[] {0, 0, 0, 0, -1}, 0, 29));
    }

    @Test
    public void beforeAndroid43TheFourthIsNotLookedAt() {
        assertEquals(1, RotationVector.read(new float[] {0, 0, 0, 0}, 0, 17)
                .deviceToWorld.w, NEAR);
        assertEquals(0.8, RotationVector.read(new float[] {0.6f, 0, 0}, 0, 16)
                .deviceToWorld.w, NEAR);
    }

    @Test
    public void theFifthIsTheAccuracy() {
        assertEquals(0.8, RotationVector.read(new float[] {0.6f, 0, 0, 0.8f, 3}, 0, 29)
                .deviceToWorld.w, NEAR);
    }

    @Test
    public void whatIsNoNumberIsNoRotation() {
        float[] wrong = {Float.NaN, Float.POSITIVE_INFINITY, Float.NEGATIVE_INFINITY};
        for (float each : wrong) {
            for (int place = 0; place < 4; place++) {
                float[] values = {0.5f, 0.5f, 0.5f, 0.5f};
                values[place] = each;
                assertNull(RotationVector.read(values, 0, 29));
            }
        }
    }

    @Test
    public void tooFewAreNoRotation() {
        assertNull(RotationVector.read(new float[] {0, 0}, 0, 29));
    }
}
