package org.raspilot.app.view;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import org.junit.Test;

public final class BarsGeometryTest {
    @Test
    public void aPulseIsAShareOfTheScale() {
        assertEquals(-1, BarsGeometry.share(1000), 0);
        assertEquals(0, BarsGeometry.share(1500), 0);
        assertEquals(0.5, BarsGeometry.share(1750), 0);
        assertEquals(1.1, BarsGeometry.share(3000), 1e-6);
        assertEquals(-1.1, BarsGeometry.share(0), 1e-6);
    }

    @Test
    public void whatLiesBeyondTheScaleIsCalledSo() {
        assertFalse(BarsGeometry.isBeyond(1000));
        assertFalse(BarsGeometry.isBeyond(2000));
        assertTrue(BarsGeometry.isBeyond(2001));
        assertTrue(BarsGeometry.isBeyond(900));
    }
}
