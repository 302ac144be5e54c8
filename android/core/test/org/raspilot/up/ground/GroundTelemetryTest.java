package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertTrue;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.wire.ProxyRole;

/** Frames that a ground receives: their ages, their gaps, their silence, their handlers. */
public final class GroundTelemetryTest {
    @Rule
    public final GroundBench bench = new GroundBench();

    private Telemetry stamped(long beacon, long clockMs) {
        return bench.frame(beacon, "{\"system\": {\"clock_ms\": " + clockMs + "},"
                + " \"orientation\": {\"roll\": 1.0}, \"age_ms\": {\"orientation\": 30}}");
    }

    @Test
    public void theHoldUpOnTheWayIsPartOfEveryAge() {
        bench.open(ProxyRole.LISTEN);
        stamped(1, 70000);
        bench.loop.advance(100);
        assertEquals(Long.valueOf(0), stamped(2, 70100).age.frameMs(bench.loop.nowMs()));
        bench.loop.advance(600);
        // Made 200 ms after the one before, it comes 600 ms after that one.
        final Telemetry held = stamped(3, 70300);
        assertEquals(400, held.age.frameMs(bench.loop.nowMs()), 1);
        assertEquals(430, held.age.readingMs("orientation", bench.loop.nowMs()), 1);
        bench.loop.advance(300);
        assertEquals(730, held.age.readingMs("orientation", bench.loop.nowMs()), 1);
        assertFalse(bench.status.isSilent);
        bench.loop.advance(300);
        assertTrue(bench.status.isSilent);
    }

    @Test
    public void aWholeReadingIsAsOldAsItsValues() {
        bench.open(ProxyRole.LISTEN);
        final Telemetry frame = bench.frame(1, "{\"rx\": {\"ailerons\": 1500},"
                + " \"age_ms\": {\"rx\": 5000}}");
        assertEquals(Freshness.STALE, frame.freshness("rx", bench.loop.nowMs()));
        assertEquals(Freshness.STALE, frame.freshness("rx.ailerons", bench.loop.nowMs()));
    }

    @Test
    public void theWayToTheProxyIsHalfOfTheHellosRoundTrip() {
        bench.start(GroundBench.settings(ProxyRole.LISTEN, false));
        bench.loop.advance(80);
        bench.peer().accept();
        bench.loop.advance(60);
        bench.say("UP1 ok aircraft=glider seat=listen token=" + GroundBench.TOKEN);
        assertEquals(60, bench.status.roundTripMs, 0);
        assertEquals(Long.valueOf(30), stamped(1, 5000).age.frameMs(bench.loop.nowMs()));
        bench.loop.advance(150);
        assertEquals(Long.valueOf(80), stamped(2, 5100).age.frameMs(bench.loop.nowMs()));
    }

    @Test
    public void framesThatComeSecondsLateAreAsGoodAsSilence() {
        bench.open(ProxyRole.LISTEN);
        stamped(1, 0);
        for (int each = 1; each < 50; each++) {
            bench.loop.advance(100);
            stamped(1 + each, each * 50);
        }
        assertTrue(bench.status.isSilent);
        assertTrue(bench.status.isLate);
        assertEquals("late", bench.status.silenceCode());
        assertEquals(Freshness.STALE, bench.ground.telemetry()
                .freshness("orientation.roll", bench.loop.nowMs()));
        assertEquals("late", bench.ground.alarms().snapshot().active.get(0).code);
    }

    @Test
    public void anAircraftThatBeganAnewBeginsItsClockAnew() {
        bench.open(ProxyRole.LISTEN);
        stamped(1, 900000);
        bench.loop.advance(100);
        assertEquals(Long.valueOf(0), stamped(2, 100).age.frameMs(bench.loop.nowMs()));
        bench.loop.advance(100);
        assertEquals(Long.valueOf(0), stamped(5000000, 150).age.frameMs(bench.loop.nowMs()));
        assertEquals(0, bench.ground.status().lostFrames);
    }

    @Test
    public void silenceIsToldWithinASecondAndItsEndAtOnce() {
        bench.open(ProxyRole.LISTEN);
        bench.fly(1, 5);
        assertFalse(bench.status.isSilent);
        bench.loop.advance(900);
        assertFalse(bench.status.isSilent);
        bench.loop.advance(1);
        assertTrue(bench.status.isSilent);
        assertEquals("silent", bench.status.silenceCode());
        assertTrue(bench.ground.alarms().snapshot().has("silent"));
        assertTrue(bench.events().contains("silent"));
        bench.frame(6, "{}");
        assertFalse(bench.status.isSilent);
    }

    @Test
    public void aLostLinkMakesTheNewestFrameStaleAtOnce() {
        bench.open(ProxyRole.LISTEN);
        bench.frame(1, "{\"altitude\": 5}");
        bench.peer().end("lost");
        assertEquals(2, bench.frames.size());
        assertTrue(bench.frames.get(1).age.isLinkLost);
        assertEquals(Freshness.STALE,
                bench.ground.telemetry().freshness("altitude", bench.loop.nowMs()));
        assertEquals(5, bench.ground.telemetry().number("altitude"), 0);
        bench.loop.advance(700);
        bench.accept(ProxyRole.LISTEN);
        assertTrue(bench.ground.status().isSilent);
        bench.frame(2, "{\"altitude\": 6}");
        assertEquals(Freshness.LIVE,
                bench.ground.telemetry().freshness("altitude", bench.loop.nowMs()));
    }

    @Test
    public void framesThatTheBeaconsSayAreMissingAreCountedAndSoIsTheRate() {
        bench.open(ProxyRole.LISTEN);
        assertNull(bench.ground.status().rateHz);
        bench.fly(1, 20);
        bench.fly(25, 5);
        final GroundStatus now = bench.ground.status();
        assertEquals(4, now.lostFrames);
        assertEquals(25, now.frames);
        assertEquals(10, now.rateHz, 0.01);
        bench.loop.advance(10001);
        assertNull(bench.ground.status().rateHz);
    }

    @Test
    public void framesThatTheAircraftLeftOutAreNotLost() {
        bench.open(ProxyRole.LISTEN);
        bench.frame(1, "{\"uplink\": {\"left_out\": 7}}");
        bench.frame(6, "{\"uplink\": {\"left_out\": 10}}");
        assertEquals(1, bench.ground.status().lostFrames);
        bench.frame(10, "{\"uplink\": {\"left_out\": 13}}");
        assertEquals(1, bench.ground.status().lostFrames);
    }

    @Test
    public void beaconsOfAnyValueAreTaken() {
        bench.open(ProxyRole.LISTEN);
        bench.frame(Long.MAX_VALUE, "{}");
        bench.frame(Long.MIN_VALUE, "{}");
        bench.frame(Long.MAX_VALUE, "{}");
        assertEquals(0, bench.ground.status().lostFrames);
    }

    @Test
    public void aHandlerReadsWhatItsTypeSaysAndHearsItsAge() {
        bench.open(ProxyRole.LISTEN);
        final List<String> rolls = new ArrayList<>();
        bench.executor.registerCommand(Telemetry.NAME,
                new BaseTelemetryHandler<Double>(bench.ground) {
                    @Override
                    protected Double read(Telemetry telemetry) {
                        return telemetry.number("orientation.roll");
                    }

                    @Override
                    protected void onTelemetry(Double roll, Age age) {
                        final long nowMs = bench.loop.nowMs();
                        rolls.add(roll + " " + age.readingMs("orientation", nowMs));
                    }
                });
        stamped(1, 10);
        bench.frame(2, "{\"orientation\": {\"roll\": \"left\"}}");
        bench.loop.advance(50);
        stamped(3, 60);
        assertEquals(Arrays.asList("1.0 30", "1.0 30"), rolls);
    }

    @Test
    public void aHandlerThatFailsKeepsTheFrameFromNobody() {
        bench.open(ProxyRole.LISTEN);
        bench.executor.registerCommand(Telemetry.NAME,
                new BaseTelemetryHandler<Telemetry>(bench.ground) {
                    @Override
                    protected Telemetry read(Telemetry telemetry) {
                        throw new IllegalStateException("a handler's own fault");
                    }

                    @Override
                    protected void onTelemetry(Telemetry telemetry, Age age) {
                    }
                });
        final Telemetry frame = bench.frame(1, "{}");
        assertSame(frame, bench.ground.telemetry());
        assertEquals(1, bench.handlerFaults.size());
    }

    @Test
    public void theStatusTellsWhatTheAircraftPermits() {
        bench.open(ProxyRole.LISTEN);
        bench.frame(1, "{\"ground\": {\"role\": \"operator\", \"tune_in_flight\": true},"
                + " \"location\": {\"latitude\": 49.0, \"longitude\": 15.0},"
                + " \"home\": {\"distance\": 1111.95, \"bearing\": 180.0}}");
        final GroundStatus now = bench.ground.status();
        assertEquals("operator", now.commandRole);
        assertEquals(true, now.tuneInFlight);
        final Home home = bench.ground.track().snapshot().origin;
        assertEquals(48.99, home.latitudeDeg, 1e-5);
        assertEquals(15.0, home.longitudeDeg, 1e-9);
    }
}
