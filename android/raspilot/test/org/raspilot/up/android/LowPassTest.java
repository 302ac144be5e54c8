package org.raspilot.up.android;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import org.junit.Test;

public final class LowPassTest {
    private final LowPass smooth = new LowPass(200);

    @Test
    public void theFirstValuesAreTakenWhole() {
        assertFalse(smooth.isKnown());
        smooth.update(new float[] {1, 2, 3}, 5000);
        assertTrue(smooth.isKnown());
        assertEquals(2, smooth.values()[1], 0);
    }

    @Test
    public void afterOneTimeConstantTwoThirdsAreReached() {
        smooth.update(new float[] {0, 0, 0}, 0);
        smooth.update(new float[] {10, 0, 0}, 200);
        assertEquals(10 * (1 - Math.exp(-1)), smooth.values()[0], 1e-5);
    }

    @Test
    public void whatIsNoNumberIsLeftOut() {
        smooth.update(new float[] {1, 1, 1}, 0);
        smooth.update(new float[] {2, Float.NaN, 2}, 1000);
        assertEquals(1, smooth.values()[0], 0);
    }

    @Test
    public void aClockThatGoesBackChangesNothing() {
        smooth.update(new float[] {1, 1, 1}, 1000);
        smooth.update(new float[] {9, 9, 9}, 500);
        assertEquals(1, smooth.values()[0], 0);
    }
}
