package org.raspilot.up.airborne;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.util.ArrayList;
import java.util.List;
import org.junit.After;
import org.junit.Test;
import org.raspilot.up.loop.ScriptedNetwork;
import org.raspilot.up.providers.AltitudeProvider.Pressure;
import org.raspilot.up.providers.BatteryProvider.BatteryLevel;
import org.raspilot.up.providers.Fix;
import org.raspilot.up.providers.Mounting;
import org.raspilot.up.providers.ProviderStatus.ProviderState;
import org.raspilot.up.providers.ProviderStatus;
import org.raspilot.up.providers.Side;

/** What a phone on board sends, in which rhythm, over lost links, and what it shows. */
public final class AirborneTest {
    private final AirborneBench bench = new AirborneBench();

    @After
    public void nothingThrew() {
        bench.faults.mustBeNone();
    }

    @Test
    public void onANewLinkEverythingIsToldAtOnce() {
        bench.start(AirborneBench.fixed().build());
        bench.gps.give(AirborneBench.HERE);
        bench.barometer.give(new Pressure(1013.25));
        bench.rotation.give(AirborneBench.LEVEL);
        bench.battery.give(new BatteryLevel(83));
        bench.accept(50001);
        List<String> lines = bench.lines();
        assertEquals(4, lines.size());
        assertTrue(lines.get(0), lines.get(0).startsWith("{\"name\": \"up.location.update\", "
                + "\"data\": {\"latitude\": 48.1, \"longitude\": 17.1, \"altitude\": 150.0}, "));
        assertEquals("{\"name\": \"up.altitude.change\", \"data\": {\"altitude\": 0.0}, "
                + "\"id\": null}", lines.get(1));
        assertEquals("{\"name\": \"up.heading.change\", \"data\": {\"heading\": 0.0, "
                + "\"mode\": \"actual\"}, \"id\": null}", lines.get(2));
        assertEquals("{\"name\": \"android.battery\", \"data\": {\"level\": 83}, "
                + "\"id\": null}", lines.get(3));
        assertEquals("[connected 10.0.0.1:50001:50000]", bench.events.toString());
    }

    @Test
    public void thenEachInItsPeriod() {
        bench.connected(AirborneBench.fixed().build());
        bench.fly(20, 1000);
        bench.lines();
        bench.fly(20, 60000);
        List<String> lines = bench.lines();
        assertEquals(120, AirborneBench.count(lines, "up.location.update"), 1);
        assertEquals(300, AirborneBench.count(lines, "up.altitude.change"), 1);
        assertEquals(300, AirborneBench.count(lines, "up.heading.change"), 1);
        assertEquals(6, AirborneBench.count(lines, "android.battery"), 1);
    }

    @Test
    public void ofAStalledLinkTheNewestReadingsCome() {
        bench.connected(AirborneBench.fixed().build());
        bench.fly(20, 1000);
        ScriptedNetwork.Connection connection = bench.general();
        connection.written();
        connection.room = 0;
        bench.fly(20, 1800);
        bench.loop.advance(1000);
        bench.gps.give(new Fix(1, 2, null, null, null, null, null, null));
        connection.makeRoom(Integer.MAX_VALUE);
        List<String> lines = bench.lines();
        assertEquals(1, AirborneBench.count(lines, "up.location.update"));
        assertTrue(lines.toString(), lines.toString().contains("\"latitude\": 1.0"));
        assertEquals(1, AirborneBench.count(lines, "up.altitude.change"));
        assertEquals(1, AirborneBench.count(lines, "up.heading.change"));
    }

    @Test
    public void nothingOldIsSentAfterAReconnect() {
        bench.connected(AirborneBench.fixed().build());
        bench.fly(20, 1000);
        bench.general().end("the Raspberry Pi closed the connection");
        bench.loop.advance(0);
        bench.gps.give(new Fix(11, 11, null, null, null, null, null, null));
        bench.barometer.give(new Pressure(900));
        bench.rotation.give(AirborneBench.LEVEL);
        bench.loop.advance(5000);
        bench.accept(50001);
        assertEquals(1, bench.lines().size());
        bench.fly(20, 20);
        List<String> fresh = bench.lines();
        assertEquals(3, fresh.size());
        assertFalse(fresh.toString(), fresh.toString().contains("11.0"));
        assertTrue(bench.events.toString(), bench.events.contains("lost: closed"));
    }

    @Test
    public void afterTheStopNothingIsLeftBehind() {
        Airborne airborne = bench.connected(AirborneBench.blackBox().build());
        bench.accept(50000);
        bench.fly(20, 1000);
        airborne.stop();
        bench.loop.advance(0);
        assertTrue(bench.general().isClosed);
        assertTrue(bench.to(50000).isClosed);
        assertEquals(0, bench.loop.pendingTimers());
        assertEquals(null, bench.gps.listener);
        airborne.start();
        bench.loop.advance(0);
        bench.accept(50001);
        bench.fly(20, 1000);
        assertTrue(bench.lines().size() > 10);
    }

    @Test
    public void theScreenIsToldLinkProvidersAndCounters() {
        Airborne airborne = bench.start(AirborneBench.fixed().build());
        AirborneStatus before = airborne.status();
        assertEquals("connecting to 10.0.0.1:50001", before.linkText);
        assertFalse(before.isConnected);
        bench.accept(50001);
        bench.fly(20, 2000);
        bench.hear("{\"name\": \"up.telemetry.update\", \"data\": {}, \"beacon\": 3}");
        bench.hear("{\"name\": \"up.panic\", \"data\": {\"panic\": true, \"delay_ms\": 150}}");
        bench.hear("{\"name\": \"android.speak\", \"data\": {}}");
        bench.hear("nonsense");
        AirborneStatus status = airborne.status();
        assertTrue(status.isConnected);
        assertEquals("connected to 10.0.0.1:50001", status.linkText);
        assertEquals("10.0.0.1:50001:50000", status.endpoint.toString());
        assertEquals(150, status.panicDelayMs);
        assertEquals(1, status.counters.connections);
        assertEquals(1, status.counters.telemetry);
        assertEquals(1, status.counters.executed);
        assertEquals(1, status.counters.refused);
        assertEquals(1, status.counters.malformed);
        assertEquals("[location, altitude, heading, battery]", names(status).toString());
        assertEquals(ProviderState.SENDING, status.providers.get(0).state);
        assertEquals(2, status.providers.get(0).rateHz, 0);
    }

    @Test
    public void absentSensorsAreToldAndTheOthersFly() {
        bench.barometer.isPresent = false;
        bench.rotation.isPresent = false;
        Airborne airborne = bench.connected(AirborneBench.blackBox().build());
        bench.fly(20, 20);
        assertEquals("[provider_problem, provider_problem, provider_problem,"
                + " connected 10.0.0.1:50001:50000]",
                bench.events.toString());
        assertEquals(2, bench.lines().size());
        assertEquals(ProviderState.ABSENT, airborne.status().providers.get(1).state);
    }

    @Test
    public void aSensorThatFallsSilentIsToldOnceAndAgainWhenItSpeaks() {
        bench.connected(AirborneBench.fixed().build());
        bench.fly(20, 1000);
        bench.events.clear();
        for (int at = 0; at < 20; at++) {
            bench.loop.advance(500);
            bench.gps.give(AirborneBench.HERE);
            bench.rotation.give(AirborneBench.LEVEL);
        }
        assertEquals("[sensor_silent]", bench.events.toString());
        bench.fly(20, 1000);
        assertEquals("[sensor_silent, sensor_recovered]",
                bench.events.toString());
    }

    @Test
    public void whyThereIsNoLinkIsToldOnce() {
        bench.start(AirborneBench.fixed().build());
        for (int attempt = 0; attempt < 5; attempt++) {
            bench.general().end("10.0.0.1 refuses the connection");
            bench.loop.advance(10000);
        }
        assertEquals(1, count("closed"));
    }

    @Test
    public void aMountingHoldsForHeadingAndOrientationAtOnce() {
        Airborne airborne = bench.connected(AirborneBench.blackBox().build());
        bench.accept(50000);
        airborne.setMounting(Mounting.of(Side.RIGHT, Side.SCREEN));
        bench.loop.advance(200);
        bench.rotation.give(AirborneBench.LEVEL);
        assertEquals("heading 90.0, mode actual", airborne.status().providers.get(2).lastText);
        assertTrue(airborne.status().providers.get(4).lastText.matches(
                "roll -?0.0, pitch -?0.0, yaw 90.0"));
    }

    @Test
    public void theAltitudeIsZeroWhereItIsSetSo() {
        Airborne airborne = bench.connected(AirborneBench.fixed().build());
        bench.barometer.give(new Pressure(987));
        assertEquals(987, airborne.zeroAltitudeHere(), 0);
        bench.lines();
        bench.loop.advance(200);
        bench.barometer.give(new Pressure(987));
        assertTrue(bench.lines().get(0).contains("{\"altitude\": 0.0}"));
    }

    @Test
    public void aNetworkThatCameBackIsTriedAtOnce() {
        Airborne airborne = bench.start(AirborneBench.fixed().build());
        bench.general().end("no network");
        bench.loop.advance(0);
        int before = bench.network.connections.size();
        airborne.networkChanged();
        bench.loop.advance(0);
        assertEquals(before + 1, bench.network.connections.size());
    }

    private int count(String event) {
        int count = 0;
        for (String each : bench.events) {
            count += each.equals(event) ? 1 : 0;
        }
        return count;
    }

    private static List<String> names(AirborneStatus status) {
        List<String> names = new ArrayList<>();
        for (ProviderStatus provider : status.providers) {
            names.add(provider.name);
        }
        return names;
    }
}
