package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import org.junit.Test;
import org.raspilot.up.providers.AltitudeProvider.Pressure;

/** The altitude by the pressure, over the sea or over the field. */
public final class AltitudeProviderTest {
    private final ProvidersBench bench = new ProvidersBench();
    private final TestSource<Pressure> barometer = new TestSource<>("barometer");
    private final AltitudeProvider provider = new AltitudeProvider(barometer, 200);

    @Test
    public void itIsThatOfTheStandardAtmosphere() {
        // ICAO Doc 7488: geopotential altitudes and pressures.
        double[][] table = {{-500, 1074.78}, {0, 1013.25}, {500, 954.61}, {1000, 898.746},
            {3000, 701.085}, {5000, 540.199}, {8000, 356.0}, {11000, 226.32}, {15000, 120.45},
            {20000, 54.7489}};
        for (double[] row : table) {
            assertEquals(row[0], StandardAtmosphere.altitudeM(row[1], 1013.25), 0.5);
        }
        for (double altitudeM = -500; altitudeM < 11000; altitudeM += 333) {
            double hPa = 1021 * Math.pow(1 - 0.0065 / 288.15 * altitudeM, 5.25588);
            assertEquals(altitudeM, StandardAtmosphere.altitudeM(hPa, 1021), 0.01);
        }
    }

    @Test
    public void aReadingLeavesAsAnAltitude() {
        bench.run(provider);
        barometer.give(new Pressure(954.61));
        assertEquals("up.altitude.change {altitude=499.99}", bench.sink.last());
    }

    @Test
    public void theQnhShiftsIt() {
        bench.run(provider);
        provider.setReferenceHPa(1030);
        barometer.give(new Pressure(1030));
        assertEquals("up.altitude.change {altitude=0.0}", bench.sink.last());
    }

    @Test
    public void zeroHereIsTheFieldsPressure() {
        bench.run(provider);
        barometer.give(new Pressure(990.5));
        assertEquals(990.5, provider.zeroHere(), 0);
        bench.loop.advance(200);
        barometer.give(new Pressure(990.5));
        assertEquals("up.altitude.change {altitude=0.0}", bench.sink.last());
        bench.loop.advance(200);
        barometer.give(new Pressure(978.7));
        double altitudeM = (Double) bench.sink.commands.get(2).data().get("altitude");
        assertEquals("8.3 m a hectopascal", 100, altitudeM, 3);
    }

    @Test
    public void zeroHereNeedsAReading() {
        bench.run(provider);
        assertThrows(IllegalStateException.class, () -> provider.zeroHere());
    }

    @Test
    public void aStepOfThePressureLeavesWithoutDelay() {
        bench.run(provider);
        bench.feed(barometer, new Pressure(1013.25), 20, 2000);
        bench.feed(barometer, new Pressure(954.61), 20, 220);
        assertEquals("up.altitude.change {altitude=499.99}", bench.sink.last());
    }

    @Test
    public void whatIsNoReferenceIsRefused() {
        for (double bad : new double[] {299, 1101, Double.NaN, Double.POSITIVE_INFINITY, -5}) {
            assertThrows(IllegalArgumentException.class, () -> provider.setReferenceHPa(bad));
        }
    }

    @Test
    public void whatIsNoPressureIsToldAndNotSent() {
        bench.run(provider);
        for (double bad : new double[] {0, -3, Double.NaN, Double.POSITIVE_INFINITY, 1e-9}) {
            barometer.give(new Pressure(bad));
            assertTrue("" + bad, bench.status().problem.startsWith("its reading cannot be used"));
        }
        assertEquals(0, bench.sink.commands.size());
    }
}
