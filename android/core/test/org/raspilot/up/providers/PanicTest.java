package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import org.junit.Test;
import org.raspilot.up.providers.BatteryProvider.BatteryLevel;

/** Panic Mode: its input, and that every stream obeys it. */
public final class PanicTest {
    private static final Fix HERE = new Fix(48.1, 17.1, null, null, null, null, null, null);
    private static final Rotation LEVEL = new Rotation(1, 0, 0, 0, 0);

    private final ProvidersBench bench = new ProvidersBench();
    private final Panic panic = bench.controller.panic();
    private final TestSource<Fix> gps = new TestSource<>("GPS");

    @Test
    public void itTakesDelaysOfUpTo10SecondsAndNothingElse() {
        panic.apply(0.2);
        assertEquals(1, panic.delayMs());
        panic.apply(10000);
        assertEquals(10000, panic.delayMs());
        for (double bad : new double[] {-1, 10000.5, Double.NaN, Double.POSITIVE_INFINITY}) {
            IllegalArgumentException error = assertThrows(IllegalArgumentException.class, () ->
                    panic.apply(bad));
            assertEquals("delay_ms: 0 to 10000", error.getMessage());
        }
        assertEquals(10000, panic.delayMs());
    }

    @Test
    public void itLengthensPeriodsAndShortensNone() {
        panic.apply(300);
        assertEquals(300, panic.periodMs(200));
        assertEquals(500, panic.periodMs(500));
        panic.clear();
        assertFalse(panic.isOn());
        assertEquals(200, panic.periodMs(200));
    }

    @Test
    public void noStreamIsQuickerThanItsDelay() {
        bench.run(new LocationProvider(gps, 200));
        bench.feed(gps, HERE, 50, 1000);
        bench.sink.timesMs.clear();
        panic.apply(700);
        bench.feed(gps, HERE, 50, 7000);
        assertEquals(700, bench.shortestGapMs());
        assertEquals(10, bench.sink.timesMs.size(), 1);
    }

    @Test
    public void orientationKeepsToItToo() {
        TestSource<Rotation> rotation = new TestSource<>("rotation");
        bench.run(new OrientationProvider(rotation, new TestSource<>("gyroscope"),
                Mounting.FLAT, 100));
        panic.apply(150);
        bench.feed(rotation, LEVEL, 10, 3000);
        assertEquals(20, bench.sink.frames.size(), 1);
        assertTrue("gap " + bench.shortestGapMs(), bench.shortestGapMs() >= 150);
    }

    @Test
    public void whatIsRepeatedKeepsToItToo() {
        TestSource<BatteryLevel> battery = new TestSource<>("battery");
        bench.run(new BatteryProvider(battery));
        panic.apply(4000);
        battery.give(new BatteryLevel(90));
        for (int level = 89; level > 69; level--) {
            bench.loop.advance(1000);
            battery.give(new BatteryLevel(level));
        }
        assertEquals(4000, bench.shortestGapMs());
    }

    @Test
    public void afterItsEndStreamsResumeTheirOwnPeriodsAtOnce() {
        bench.run(new LocationProvider(gps, 200));
        bench.feed(gps, HERE, 50, 1000);
        panic.apply(10000);
        bench.feed(gps, HERE, 50, 1000);
        bench.sink.timesMs.clear();
        long endMs = bench.loop.nowMs();
        panic.clear();
        assertEquals(endMs, (long) bench.sink.timesMs.get(0));
        bench.feed(gps, HERE, 50, 2000);
        assertEquals(11, bench.sink.timesMs.size(), 1);
    }

    @Test
    public void aShorterDelayHoldsAtOnce() {
        bench.run(new LocationProvider(gps, 200));
        gps.give(HERE);
        panic.apply(10000);
        bench.feed(gps, HERE, 50, 400);
        panic.apply(500);
        bench.feed(gps, HERE, 50, 600);
        assertEquals("[0, 500, 1000]", bench.sink.timesMs.toString());
    }
}
