package org.raspilot.app.view;

import static org.junit.Assert.assertEquals;

import org.junit.Test;

public final class CompassGeometryTest {
    private static final String[] POINTS = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};

    @Test
    public void anyDirectionIsWithinOneTurn() {
        assertEquals(350, CompassGeometry.wrapped(-10), 0);
        assertEquals(10, CompassGeometry.wrapped(370), 0);
        assertEquals(0, CompassGeometry.wrapped(360), 0);
        assertEquals(0, CompassGeometry.wrapped(-1e-9f), 0);
    }

    @Test
    public void theWayToADirectionIsTheShortOne() {
        assertEquals(20, CompassGeometry.turn(350, 10), 0);
        assertEquals(-20, CompassGeometry.turn(10, 350), 0);
        assertEquals(180, CompassGeometry.turn(0, 180), 0);
        assertEquals(-90, CompassGeometry.turn(-90, 180), 0);
    }

    @Test
    public void directionsHaveThreeFiguresAndNeverThreeHundredSixty() {
        assertEquals("000", CompassGeometry.figures(359.6f));
        assertEquals("007", CompassGeometry.figures(7.2f));
        assertEquals("090", CompassGeometry.figures(90));
        assertEquals("270", CompassGeometry.figures(-90));
    }

    @Test
    public void pointsStandEachFortyFiveDegreesAndNumbersEachThirty() {
        assertEquals("N", CompassGeometry.label(0, POINTS));
        assertEquals("N", CompassGeometry.label(-360, POINTS));
        assertEquals("NE", CompassGeometry.label(45, POINTS));
        assertEquals("W", CompassGeometry.label(-90, POINTS));
        assertEquals("30", CompassGeometry.label(390, POINTS));
        assertEquals("", CompassGeometry.label(15, POINTS));
    }

    @Test
    public void theNearestPointIsNamed() {
        assertEquals("N", CompassGeometry.point(359, POINTS));
        assertEquals("N", CompassGeometry.point(22, POINTS));
        assertEquals("NE", CompassGeometry.point(23, POINTS));
        assertEquals("W", CompassGeometry.point(-90, POINTS));
    }
}
