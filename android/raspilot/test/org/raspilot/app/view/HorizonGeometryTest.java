package org.raspilot.app.view;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import org.junit.Test;

public final class HorizonGeometryTest {
    private static final float CLOSE = 1e-4f;

    private static HorizonGeometry of(float rollDeg, float pitchDeg) {
        HorizonGeometry geometry = new HorizonGeometry();
        geometry.resize(300, 200);
        geometry.turn(rollDeg, pitchDeg);
        return geometry;
    }

    private static int rung(HorizonGeometry geometry, float pitchDeg) {
        for (int rung = 0; rung < geometry.rungCount(); rung++) {
            if (geometry.rungDeg(rung) == pitchDeg) {
                return rung;
            }
        }
        throw new AssertionError("no rung at " + pitchDeg);
    }

    @Test
    public void rightWingDownTurnsTheBallToTheLeft() {
        assertEquals(-30, of(30, 0).ballRotationDeg(), CLOSE);
        assertEquals(45, of(-45, 0).ballRotationDeg(), CLOSE);
    }

    @Test
    public void noseUpMovesTheHorizonDown() {
        assertTrue(of(0, 10).ballShift() > 0);
        assertTrue(of(0, -10).ballShift() < 0);
        assertEquals(0, of(20, 0).ballShift(), CLOSE);
    }

    @Test
    public void theRungOfThePitchFlownStandsInTheMiddle() {
        HorizonGeometry geometry = of(0, 20);
        int rung = rung(geometry, 20);
        assertEquals(0, geometry.rungY(rung) + geometry.ballShift(), CLOSE);
    }

    @Test
    public void beyondTheZenithTheBallStaysThere() {
        assertEquals(of(0, 90).ballShift(), of(0, 140).ballShift(), CLOSE);
        assertEquals(of(0, -90).ballShift(), of(0, -90.5f).ballShift(), CLOSE);
    }

    @Test
    public void rungsAreLongEachTenDegreesAndOnlyThoseAreNumbered() {
        HorizonGeometry geometry = of(0, 0);
        int ten = rung(geometry, 10);
        int five = rung(geometry, -5);
        int fine = rung(geometry, 2.5f);
        assertTrue(geometry.isLabelled(ten));
        assertFalse(geometry.isLabelled(five));
        assertTrue(geometry.rungHalfWidth(ten) > geometry.rungHalfWidth(five));
        assertTrue(geometry.rungHalfWidth(five) > geometry.rungHalfWidth(fine));
    }

    @Test
    public void theLadderReachesZenithAndNadirWithoutARungAtTheHorizon() {
        HorizonGeometry geometry = of(0, 0);
        rung(geometry, 90);
        rung(geometry, -90);
        for (int rung = 0; rung < geometry.rungCount(); rung++) {
            assertTrue(geometry.rungDeg(rung) != 0);
        }
    }

    @Test
    public void onlyRungsWithinTheRollScaleAreDrawn() {
        HorizonGeometry geometry = of(0, 50);
        assertTrue(geometry.isRungVisible(rung(geometry, 50)));
        assertFalse(geometry.isRungVisible(rung(geometry, 90)));
        assertFalse(geometry.isRungVisible(rung(geometry, -10)));
    }

    @Test
    public void anglesOnACircleRunClockwiseFromAbove() {
        assertEquals(0, HorizonGeometry.circleX(0, 10), CLOSE);
        assertEquals(-10, HorizonGeometry.circleY(0, 10), CLOSE);
        assertEquals(10, HorizonGeometry.circleX(90, 10), CLOSE);
        assertEquals(0, HorizonGeometry.circleY(90, 10), 1e-3);
    }
}
