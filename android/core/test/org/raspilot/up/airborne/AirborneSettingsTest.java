package org.raspilot.up.airborne;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;
import static org.junit.Assert.fail;

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
    public void whatIsOutOfRangeIsRefusedByASentence() {
        refused(builder().generalPort(0), "the port of the Raspberry Pi is 1 to 65535, not 0");
        refused(builder().orientationPort(65536), "the port for orientation is 1 to 65535");
        refused(builder().discoveryPort(-1), "the port of Discovery is");
        refused(builder().runnerPort(70000), "the runner's port is");
        refused(builder().host("a b"), "the host is a name or an address");
        refused(builder().host("http://pi"), "the host is a name or an address");
        refused(builder().host(null), "the host is missing");
        refused(builder().discoveryHosts(Arrays.asList("")), "an address of Discovery is empty");
        refused(builder().aircraft(".hidden"), "the aircraft's name is 1 to 32");
        refused(builder().aircraft("a/b"), "the aircraft's name is 1 to 32");
        refused(builder().orientationHz(49), "the rate of orientation (Hz) is 50 to 200, not 49");
        refused(builder().orientationHz(201), "the rate of orientation (Hz) is 50 to 200");
        refused(builder().locationPeriodMs(19), "the period of the location (ms) is 20 to 10000");
        refused(builder().altitudePeriodMs(10001), "the period of the altitude (ms) is");
        refused(builder().headingPeriodMs(0), "the period of the heading (ms) is");
        refused(builder().declinationDeg(Double.NaN), "the declination (deg) is -180 to 180");
        refused(builder().referencePressureHPa(29.92), "the reference pressure (hPa) is 300");
        refused(builder().mounting(null), "the mounting is missing");
        refused(builder().mode(null), "the mode is missing");
        refused(builder().orientation(null), "the way of orientation is missing");
        refused(builder().mode(AirborneMode.BLACK_BOX), "Black Box Mode needs the runner's host");
    }

    @Test
    public void whatIsSetLaterDoesNotChangeSettingsThatAreMade() {
        List<String> hosts = Arrays.asList("10.0.0.255");
        AirborneSettings settings = builder().discoveryHosts(hosts).build();
        hosts.set(0, "changed");
        assertEquals("[10.0.0.255]", settings.discoveryHosts.toString());
        try {
            settings.discoveryHosts.set(0, "changed");
            fail("changed");
        } catch (UnsupportedOperationException error) {
            assertEquals(1, settings.discoveryHosts.size());
        }
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

    private static void refused(AirborneSettings.Builder builder, String sentence) {
        try {
            builder.build();
            fail("taken, against: " + sentence);
        } catch (IllegalArgumentException error) {
            assertTrue(error.getMessage(), error.getMessage().startsWith(sentence));
        }
    }
}
