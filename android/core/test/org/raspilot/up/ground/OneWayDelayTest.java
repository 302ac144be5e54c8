package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.util.Random;
import org.junit.Test;

/** How late a message is by its sender's clock: the rules of the Python ground station. */
public final class OneWayDelayTest {
    private final OneWayDelay delay = new OneWayDelay();

    @Test
    public void theQuickestMessageIsTheMeasureOfTheOthers() {
        assertEquals(0, delay.update(1000.0, 50000), 0);
        assertTrue(delay.isReset());
        assertEquals(300, delay.update(1100.0, 50400), 0.1);
        assertFalse(delay.isReset());
        assertEquals("a quicker one", 0, delay.update(1200.0, 50150), 0);
        assertEquals(350, delay.update(1300.0, 50600), 0.1);
    }

    @Test
    public void aQueueThatStandsForMinutesIsNotTakenForTheWay() {
        delay.update(0.0, 0);
        double held = 0;
        for (int second = 1; second <= 300; second++) {
            held = delay.update(second * 1000.0, second * 1000 + 2000);
        }
        assertEquals(2000, held, 2 * 300000 * TelemetrySchema.DRIFT);
        assertTrue(held <= 2000);
    }

    @Test
    public void aClockThatGoesBackOrFallsFarBehindIsAnotherOne() {
        delay.update(500000.0, 1000);
        assertEquals(0, delay.update(10.0, 1100), 0);
        assertTrue(delay.isReset());
        assertEquals(0, delay.update(110.0, 1200 + 31000), 0);
        assertTrue(delay.isReset());
    }

    @Test
    public void withoutAClockNothingIsTold() {
        assertNull(delay.update(null, 5));
        delay.update(0.0, 0);
        delay.reset();
        assertEquals(0, delay.update(100.0, 900), 0);
    }

    @Test
    public void aClockThatWasReadShowsTheWholeWayAndNoMessageMakesAnother() {
        delay.trust(1000, 50000, 50100);
        assertEquals(250, delay.update(1000.0, 50300), 0.1);
        delay.reset();
        assertEquals(40050, delay.update(1100.0, 90200), 40000 * TelemetrySchema.DRIFT + 0.1);
        assertFalse(delay.isReset());
    }

    @Test
    public void aSlowReadingSpoilsNoQuickOne() {
        delay.trust(1000, 50000, 50010);
        delay.trust(2000, 51000, 51900);
        assertEquals(0, delay.update(3000.0, 52005), 0.1);
        assertEquals(5, delay.update(3000.0, 52010), 0.1);
    }

    @Test
    public void aReadingOfAnotherClockReplacesTheFirst() {
        delay.trust(1000, 50000, 50010);
        delay.trust(900000, 51000, 51100);
        assertEquals(50, delay.update(900000.0, 51100), 0.1);
    }

    @Test
    public void whateverAClockSaysTheFigureIsNeverNegativeNorNoNumber() {
        final long seed = new Random().nextLong();
        final Random random = new Random(seed);
        double nowMs = 0;
        for (int each = 0; each < 20000; each++) {
            nowMs += random.nextInt(1000);
            final double stamp = (random.nextDouble() - 0.5) * Math.pow(10, random.nextInt(13));
            final Double held = delay.update(random.nextInt(9) == 0 ? null : stamp, nowMs);
            assertTrue("seed " + seed, held == null || held >= 0);
        }
    }
}
