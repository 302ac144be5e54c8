package org.raspilot.up.airborne;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import java.util.Collections;
import java.util.List;
import org.junit.After;
import org.junit.Test;
import org.raspilot.up.airborne.AirborneSettings.OrientationTransport;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.providers.RatePolicy;
import org.raspilot.up.providers.SensorProvider;
import org.raspilot.up.providers.TestSource;

/** Panic Mode applies to every sender, and ends by request or with the link. */
public final class AirbornePanicTest {
    private final AirborneBench bench = new AirborneBench();

    @After
    public void nothingThrew() {
        bench.faults.mustBeNone();
    }

    @Test
    public void everySenderKeepsItsDelayOrientationToo() {
        bench.connected(AirborneBench.blackBox().orientationHz(100).build());
        bench.accept(50000);
        final TestSource<String> own = new TestSource<>("own sensor");
        bench.airborne.providers().register(
                new SensorProvider<String>("own", own, RatePolicy.stream(50, 1000)) {
                    @Override
                    protected BaseCommand read(String reading) {
                        return new BaseCommand(
                                "my.own", Collections.singletonMap("text", reading));
                    }
                });
        panic(true, 600);
        bench.fly(10, 600);
        bench.lines();
        bench.frames();
        for (int at = 0; at < 600; at++) {
            bench.fly(10, 10);
            own.give("x");
        }
        List<String> lines = bench.lines();
        assertEquals(10, AirborneBench.count(lines, "up.location.update"), 1);
        assertEquals(10, AirborneBench.count(lines, "up.altitude.change"), 1);
        assertEquals(10, AirborneBench.count(lines, "up.heading.change"), 1);
        assertEquals(10, AirborneBench.count(lines, "my.own"), 1);
        assertEquals(10, bench.frames(), 1);
    }

    @Test
    public void datagramsOfOrientationKeepItToo() {
        bench.connected(AirborneBench.blackBox().orientation(OrientationTransport.UDP).build());
        bench.fly(10, 1000);
        panic(true, 150);
        bench.fly(10, 150);
        int before = bench.datagrams().size();
        bench.fly(10, 3000);
        assertEquals(20, bench.datagrams().size() - before, 1);
    }

    @Test
    public void afterCalmEachStreamHasItsOwnPeriodAgain() {
        bench.connected(AirborneBench.blackBox().build());
        bench.accept(50000);
        panic(true, 1000);
        bench.fly(10, 5000);
        panic(false, 1000);
        bench.fly(10, 1000);
        bench.lines();
        bench.frames();
        bench.fly(10, 2000);
        List<String> lines = bench.lines();
        assertEquals(4, AirborneBench.count(lines, "up.location.update"), 1);
        assertEquals(10, AirborneBench.count(lines, "up.altitude.change"), 1);
        assertEquals(100, bench.frames(), 1);
    }

    @Test
    public void theLinksLossEndsItForTheOrientationThatStillFliesToo() {
        bench.connected(AirborneBench.blackBox().build());
        bench.accept(50000);
        panic(true, 1000);
        bench.fly(10, 2000);
        bench.general().end("gone");
        bench.frames();
        bench.fly(10, 400);
        assertEquals(20, bench.frames(), 1);
        assertEquals(0, bench.airborne.status().panicDelayMs);
        assertTrue(bench.events.toString(),
                bench.events.toString().endsWith("panic 1000, panic 0, lost: closed]"));
    }

    @Test
    public void onANewLinkNothingOfTheOldPanicIsLeft() {
        bench.connected(AirborneBench.fixed().build());
        panic(true, 5000);
        bench.fly(20, 1000);
        bench.general().end("gone");
        bench.fly(20, 3000);
        bench.accept(50001);
        bench.fly(20, 2000);
        List<String> lines = bench.lines();
        assertEquals(5, AirborneBench.count(lines, "up.location.update"), 1);
        assertEquals(11, AirborneBench.count(lines, "up.altitude.change"), 1);
    }

    private void panic(boolean isOn, int delayMs) {
        bench.hear("{\"name\": \"up.panic\", \"data\": {\"panic\": " + isOn
                + ", \"delay_ms\": " + delayMs + "}}");
        assertEquals(isOn ? delayMs : 0, bench.airborne.status().panicDelayMs);
    }
}
