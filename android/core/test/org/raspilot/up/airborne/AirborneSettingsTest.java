package org.raspilot.up.airborne;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.util.Arrays;
import java.util.List;
import org.junit.Test;
import org.raspilot.up.airborne.AirborneSettings.AirborneMode;
import org.raspilot.up.airborne.AirborneSettings.OrientationTransport;

/** Defaults, rejected values with their messages, and the addresses of Discovery requests. */
public final class AirborneSettingsTest {

    @Test
    public void theDefaultsAreTheRaspberryPis() {
        AirborneSettings settings = new AirborneSettings.Builder().build();
        assertEquals(AirborneMode.FLIGHT_CONTROLLER, settings.mode);
        assertEquals(50001, settings.generalPort);
        assertEquals(50000, settings.orientationPort);
        assertEquals(3001, settings.discoveryPort);
        assertEquals(3002, settings.runnerPort);
        assertEquals(OrientationTransport.OFF, settings.orientationTransport());
        assertFalse(settings.isByRunner());
        assertEquals(500, settings.locationPeriodMs);
        assertEquals(200, settings.altitudePeriodMs);
        assertEquals(50, settings.orientationHz);
        assertEquals(1013.25, settings.referencePressureHPa, 0);
    }

    @Test
    public void whatIsOutOfRangeIsRefusedByItsName() {
        refused(builder().generalPort(0), "port of the Raspberry Pi");
        refused(builder().orientationPort(65536), "port for orientation");
        refused(builder().discoveryPort(-1), "port of Discovery");
        refused(builder().runnerPort(70000), "runner's port");
        refused(builder().host("a b"), "host");
        refused(builder().host("http://pi"), "host");
        refused(builder().discoveryHosts(Arrays.asList("")), "address of Discovery");
        refused(builder().aircraft(".hidden"), "aircraft's name");
        refused(builder().aircraft("a/b"), "aircraft's name");
        refused(builder().orientationHz(49), "rate of orientation (Hz)");
        refused(builder().orientationHz(201), "rate of orientation (Hz)");
        refused(builder().locationPeriodMs(19), "period of the location (ms)");
        refused(builder().altitudePeriodMs(10001), "period of the altitude (ms)");
        refused(builder().headingPeriodMs(0), "period of the heading (ms)");
        refused(builder().referencePressureHPa(29.92), "reference pressure (hPa)");
        refused(builder().mode(AirborneMode.BLACK_BOX),
                "host of the runner, or of a running server");
    }

    @Test
    public void whatIsSetLaterDoesNotChangeSettingsThatAreMade() {
        List<String> hosts = Arrays.asList("10.0.0.255");
        AirborneSettings settings = builder().discoveryHosts(hosts).build();
        hosts.set(0, "changed");
        assertEquals("[10.0.0.255]", settings.discoveryHosts.toString());
        assertThrows(UnsupportedOperationException.class, () ->
                settings.discoveryHosts.set(0, "changed"));
        assertEquals(1, settings.discoveryHosts.size());
    }

    @Test
    public void withoutAHostTheRaspberryPiIsDiscovered() {
        AirborneBench bench = new AirborneBench();
        bench.start(builder().discoveryHosts(Arrays.asList("10.0.0.255")).discoveryPort(3999)
                .build());
        bench.loop.advance(100);
        assertEquals(0, bench.network.connections.size());
        String question = bench.network.ports.get(0).sent.get(0);
        assertTrue(question, question.endsWith(" -> 10.0.0.255:3999"));
        bench.network.ports.get(0).come("10.0.0.7", "10.0.0.7", 3999);
        bench.loop.advance(0);
        assertEquals("10.0.0.7", bench.general().host);
    }

    @Test
    public void inBlackBoxModeTheRunnerIsAskedFirst() {
        AirborneBench bench = new AirborneBench();
        bench.start(builder().mode(AirborneMode.BLACK_BOX).runnerHost("runner.example")
                .aircraft("glider-1").profile("easyglider").host("ignored").build());
        bench.accept(3002);
        assertEquals("runner.example", bench.to(3002).host);
        assertEquals("{\"aircraft\": \"glider-1\", \"profile\": \"easyglider\"}\n",
                bench.to(3002).written());
        bench.to(3002).say("{\"message\": \"Raspilot spawned\", \"spawned\": true, "
                + "\"error\": null, \"myAddress\": \"1.2.3.4\", \"running\": true, \"pid\": 4, "
                + "\"instance\": \"glider-1\", \"ports\": {\"general\": 40001, "
                + "\"orientation\": 40000}, \"proxy\": null}\n");
        bench.loop.advance(0);
        assertEquals("runner.example", bench.to(40001).host);
        bench.accept(40001);
        bench.loop.advance(0);
        assertEquals("runner.example", bench.to(40000).host);
    }

    @Test
    public void aNamelessAircraftIsTheRunnersDefault() {
        AirborneBench bench = new AirborneBench();
        bench.start(builder().mode(AirborneMode.BLACK_BOX).runnerHost("runner.example").build());
        bench.accept(3002);
        assertEquals("{\"aircraft\": \"default\"}\n", bench.to(3002).written());
    }

    private static AirborneSettings.Builder builder() {
        return new AirborneSettings.Builder();
    }

    private static void refused(AirborneSettings.Builder builder, String setting) {
        String sentence = assertThrows(IllegalArgumentException.class, () -> builder.build())
                .getMessage();
        assertTrue(sentence, sentence.startsWith("the " + setting + " "));
    }
}
