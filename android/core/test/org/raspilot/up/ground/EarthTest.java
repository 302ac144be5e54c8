package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;

import java.util.Random;
import org.junit.Test;

/** Metres between places near each other. */
public final class EarthTest {
    @Test
    public void nearPlacesAreAsFarApartAsOnTheGreatCircle() {
        final long seed = new Random().nextLong();
        final Random random = new Random(seed);
        for (int each = 0; each < 500; each++) {
            final Home from = new Home(random.nextDouble() * 140 - 70,
                    random.nextDouble() * 358 - 179);
            final double distanceM = random.nextDouble() * 3000;
            final Home to = HomeEstimator.destination(from.latitudeDeg, from.longitudeDeg,
                    random.nextDouble() * 360, distanceM);
            assertEquals("seed " + seed, distanceM, Earth.distanceM(from.latitudeDeg,
                    from.longitudeDeg, to.latitudeDeg, to.longitudeDeg), 0.01);
        }
    }

    @Test
    public void eastIsTheShorterWayRound() {
        assertEquals(111195, Earth.northM(47, 48), 1);
        assertEquals(-111195, Earth.northM(48, 47), 1);
        assertEquals(22.2, Earth.eastM(179.9999, -179.9999, 0), 0.1);
        assertEquals(-22.2, Earth.eastM(-179.9999, 179.9999, 0), 0.1);
        assertEquals(111195 / 2.0, Earth.eastM(14, 15, 60), 1);
    }

    @Test
    public void metresFromAPlaceLeadToDegreesAndBack() {
        Home home = new Home(60, 179.999);
        assertEquals(61, Earth.latitudeDeg(home, 111195), 1e-4);
        double eastDeg = Earth.longitudeDeg(home, 400);
        assertEquals(-179.9938, eastDeg, 1e-3);
        assertEquals(400, Earth.eastM(home.longitudeDeg, eastDeg, 60), 0.01);
    }
}
