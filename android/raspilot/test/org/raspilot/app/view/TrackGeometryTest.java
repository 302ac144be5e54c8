package org.raspilot.app.view;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.util.Random;
import org.junit.Test;

public final class TrackGeometryTest {
    private static TrackGeometry fitted() {
        TrackGeometry geometry = new TrackGeometry();
        geometry.resize(400, 300);
        geometry.fit(-100, 300, 0, 200);
        return geometry;
    }

    @Test
    public void everythingIsWithinThePictureNorthUp() {
        TrackGeometry geometry = fitted();
        assertTrue(geometry.y(300) >= 0 && geometry.y(-100) <= 300);
        assertTrue(geometry.x(0) >= 0 && geometry.x(200) <= 400);
        assertTrue(geometry.y(300) < geometry.y(-100));
        assertTrue(geometry.x(0) < geometry.x(200));
    }

    @Test
    public void metresAreAsLongInBothDirections() {
        TrackGeometry geometry = fitted();
        assertEquals(geometry.x(110) - geometry.x(10), geometry.y(10) - geometry.y(110), 1e-3);
    }

    @Test
    public void aPointAloneIsNotEnlargedWithoutEnd() {
        TrackGeometry geometry = new TrackGeometry();
        geometry.resize(400, 300);
        geometry.fit(5, 5, 5, 5);
        assertTrue(geometry.pixelsPerM() < 10);
    }

    @Test
    public void aPinchLeavesThePointUnderTheFingersWhereItIs() {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        for (int round = 0; round < 300; round++) {
            TrackGeometry geometry = fitted();
            float x = random.nextFloat() * 400;
            float y = random.nextFloat() * 300;
            double east = geometry.eastAt(x);
            double north = geometry.northAt(y);
            geometry.zoom(0.2 + random.nextDouble() * 5, x, y);
            assertEquals("seed " + seed, x, geometry.x(east), 0.05);
            assertEquals("seed " + seed, y, geometry.y(north), 0.05);
        }
    }

    @Test
    public void aDragMovesTheWorldWithTheFinger() {
        TrackGeometry geometry = fitted();
        float x = geometry.x(0);
        float y = geometry.y(0);
        geometry.drag(30, -20);
        assertEquals(x + 30, geometry.x(0), 1e-3);
        assertEquals(y - 20, geometry.y(0), 1e-3);
    }

    @Test
    public void whatAHandMovedStaysUntilItIsLetGo() {
        TrackGeometry geometry = fitted();
        geometry.drag(50, 0);
        float x = geometry.x(0);
        geometry.fit(-5000, 5000, -5000, 5000);
        assertEquals(x, geometry.x(0), 0);
        assertFalse(geometry.isAutomatic());
        geometry.follow();
        geometry.fit(-5000, 5000, -5000, 5000);
        assertTrue(geometry.x(0) != x);
    }

    @Test
    public void aKeptPictureComesBack() {
        TrackGeometry geometry = fitted();
        geometry.zoom(2, 10, 10);
        TrackGeometry other = new TrackGeometry();
        other.resize(400, 300);
        other.restore(geometry.middleNorthM(), geometry.middleEastM(), geometry.pixelsPerM());
        assertEquals(geometry.x(77), other.x(77), 0);
        assertFalse(other.isAutomatic());
    }

    @Test
    public void nonsenseOfAGestureChangesNothing() {
        TrackGeometry geometry = fitted();
        for (double factor : new double[] {0, -1, Double.NaN, Double.POSITIVE_INFINITY}) {
            geometry.zoom(factor, 1, 1);
        }
        assertTrue(geometry.isAutomatic());
    }

    @Test
    public void theGridIsOfRoundMetresAndNeverTooFine() {
        TrackGeometry geometry = new TrackGeometry();
        for (double scale = 1e-4; scale <= 40; scale *= 1.37) {
            geometry.restore(0, 0, scale);
            double step = geometry.gridStepM(56);
            double pixels = step * scale;
            assertTrue(scale + " " + pixels, pixels > 55.99 && pixels < 56 * 2.51);
            double figure = step / Math.pow(10, Math.floor(Math.log10(step) + 1e-9));
            assertTrue(step + " m", Math.abs(figure - 1) < 1e-6 || Math.abs(figure - 2) < 1e-6
                    || Math.abs(figure - 5) < 1e-6);
        }
    }

    @Test
    public void aGridBeginsAtAMultipleOfItsStep() {
        assertEquals(-100, TrackGeometry.firstLineM(-120, 50), 0);
        assertEquals(150, TrackGeometry.firstLineM(120, 50), 0);
    }

    @Test
    public void distancesReadAsPeopleWriteThem() {
        assertEquals("0 m", TrackGeometry.distanceText(0));
        assertEquals("0.5 m", TrackGeometry.distanceText(0.5));
        assertEquals("999 m", TrackGeometry.distanceText(-999.4));
        assertEquals("1 km", TrackGeometry.distanceText(999.6));
        assertEquals("2.5 km", TrackGeometry.distanceText(2540));
        assertEquals("120 km", TrackGeometry.distanceText(120300));
    }
}
