package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import org.junit.Test;
import org.raspilot.up.providers.ProviderStatus.ProviderState;
import org.raspilot.up.wire.OrientationFrame;

/** Frames of attitude and rates: their rate, their axes, and what becomes without a gyroscope. */
public final class OrientationProviderTest {
    private final ProvidersBench bench = new ProvidersBench();
    private final TestSource<Rotation> rotation = new TestSource<>("rotation vector");
    private final TestSource<RotationRate> gyroscope = new TestSource<>("gyroscope");
    private final Mounting mounting = Mounting.of(Side.LEFT, Side.BACK);

    @Test
    public void aFrameHasTheAircraftsAttitudeAndRates() {
        bench.run(new OrientationProvider(rotation, gyroscope, mounting, 50));
        double[] nose = mounting.bodyToDevice.turn(1, 0, 0);
        gyroscope.give(new RotationRate(nose[0], nose[1], nose[2], 0));
        rotation.give(mounting.rotation(new Attitude(20, -5, 300), 0));
        OrientationFrame frame = bench.sink.frames.get(0);
        assertEquals(20, frame.rollDeg, 1e-4);
        assertEquals(-5, frame.pitchDeg, 1e-4);
        assertEquals(300, frame.yawDeg, 1e-4);
        assertEquals(57.29578, frame.rollRateDegS, 1e-4);
        assertEquals(0, frame.pitchRateDegS, 1e-4);
        assertEquals(0, frame.yawRateDegS, 1e-4);
    }

    @Test
    public void aQuickSensorIsThinnedToTheWantedRate() {
        for (int hz : new int[] {50, 60, 100, 150, 200}) {
            ProvidersBench other = new ProvidersBench();
            TestSource<Rotation> quick = new TestSource<>("quick");
            other.run(new OrientationProvider(quick, gyroscope, mounting, hz));
            other.feed(quick, new Rotation(1, 0, 0, 0, 0), 1, 10000);
            other.controller.stop();
            gyroscope.unsubscribe();
            assertEquals(10.0 * hz, other.sink.frames.size(), 1);
        }
    }

    @Test
    public void theScreenIsToldTheRateOfTheLastSecond() {
        bench.run(new OrientationProvider(rotation, gyroscope, mounting, 200));
        bench.feed(rotation, mounting.rotation(new Attitude(1, 2, 3), 0), 5, 3000);
        assertEquals(200, bench.status().rateHz, 1);
        assertEquals("roll 1.0, pitch 2.0, yaw 3.0", bench.status().lastText);
        assertTrue(bench.status().sensor.contains("gyroscope"));
        bench.loop.advance(501);
        assertEquals(ProviderState.SILENT, bench.status().state);
        bench.loop.advance(500);
        assertEquals(0, bench.status().rateHz, 0);
    }

    @Test
    public void withoutAGyroscopeTheRatesAreThoseOfTheAttitude() {
        gyroscope.isPresent = false;
        bench.run(new OrientationProvider(rotation, gyroscope, mounting, 50));
        assertTrue(bench.status().sensor.contains("no gyroscope"));
        assertEquals(0, gyroscope.periodsMs.size());
        for (int at = 0; at < 20; at++) {
            bench.loop.advance(20);
            rotation.give(mounting.rotation(new Attitude(3 * at, 0, 0), bench.loop.nowMs()));
        }
        assertEquals(150, bench.sink.frames.get(19).rollRateDegS, 0.01);
    }

    @Test
    public void aGyroscopeThatFellSilentIsNotBelieved() {
        bench.run(new OrientationProvider(rotation, gyroscope, mounting, 50));
        gyroscope.give(new RotationRate(9, 9, 9, 0));
        for (int at = 0; at < 20; at++) {
            bench.loop.advance(20);
            rotation.give(mounting.rotation(new Attitude(0, 0, 0), bench.loop.nowMs()));
        }
        assertTrue(bench.sink.frames.get(0).rollRateDegS != 0);
        assertEquals(0, bench.sink.frames.get(19).rollRateDegS, 1e-6);
    }

    @Test
    public void aRateThatNobodyTakesIsToldAndNotSent() {
        bench.run(new OrientationProvider(rotation, gyroscope, mounting, 50));
        for (double bad : new double[] {Double.NaN, 1e9}) {
            gyroscope.give(new RotationRate(bad, 0, 0, bench.loop.nowMs()));
            rotation.give(new Rotation(1, 0, 0, 0, bench.loop.nowMs()));
            assertEquals(0, bench.sink.frames.size());
            assertTrue(bench.status().problem, bench.status().problem.contains("rate"));
            bench.loop.advance(20);
        }
    }

    @Test
    public void theDeclinationTurnsTheYaw() {
        OrientationProvider provider =
                new OrientationProvider(rotation, gyroscope, Mounting.FLAT, 50);
        provider.setDeclinationDeg(5);
        bench.run(provider);
        rotation.give(new Rotation(1, 0, 0, 0, 0));
        assertEquals(5, bench.sink.frames.get(0).yawDeg, 1e-4);
    }

    @Test
    public void bothSensorsAreLeftAtItsEnd() {
        bench.run(new OrientationProvider(rotation, gyroscope, mounting, 50));
        assertEquals("[20]", rotation.periodsMs.toString());
        bench.controller.stop();
        assertEquals(null, rotation.listener);
        assertEquals(null, gyroscope.listener);
    }
}
