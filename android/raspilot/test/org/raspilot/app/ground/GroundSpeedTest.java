package org.raspilot.app.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;

import org.junit.Test;

public final class GroundSpeedTest {
    /** One metre north, degrees. */
    private static final double METRE_DEG = Math.toDegrees(1 / 6371009.0);

    private final GroundSpeed speed = new GroundSpeed();

    @Test
    public void theSpeedIsTheWayOverTheTime() {
        for (int second = 0; second < 5; second++) {
            speed.update(47 + 12 * second * METRE_DEG, 8, 1000L * second);
        }
        assertEquals(12, speed.metresPerSecond(), 0.01);
    }

    @Test
    public void aPlaceAloneTellsNoSpeed() {
        assertNull(speed.metresPerSecond());
        speed.update(47, 8, 0);
        assertNull(speed.metresPerSecond());
    }

    @Test
    public void theSameFixInManyFramesCountsOnce() {
        for (int second = 0; second < 4; second++) {
            for (int frame = 0; frame < 10; frame++) {
                // Ages jitter by some ms from frame to frame.
                speed.update(47 + 10 * second * METRE_DEG, 8, 1000L * second + frame % 3 * 10);
            }
        }
        assertEquals(10, speed.metresPerSecond(), 0.2);
    }

    @Test
    public void afterASilenceTheOldPlacesCountNoMore() {
        speed.update(47, 8, 0);
        speed.update(47 + 10 * METRE_DEG, 8, 1000);
        speed.update(47.1, 8, 20000);
        assertNull(speed.metresPerSecond());
    }

    @Test
    public void theDateLineIsNoWay() {
        speed.update(0, 179.99999, 0);
        speed.update(0, -179.99999, 1000);
        assertEquals(2.22, speed.metresPerSecond(), 0.05);
    }

    @Test
    public void whatStandsStillHasNoSpeed() {
        for (int second = 0; second < 30; second++) {
            speed.update(47, 8, 1000L * second);
        }
        assertEquals(0, speed.metresPerSecond(), 0);
    }

    @Test
    public void nothingIsKnownAfterClear() {
        speed.update(47, 8, 0);
        speed.update(47.001, 8, 1000);
        speed.clear();
        assertNull(speed.metresPerSecond());
    }
}
