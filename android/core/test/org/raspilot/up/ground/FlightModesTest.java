package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNotEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.util.Arrays;
import java.util.ArrayList;
import java.util.Map;
import org.junit.Test;

/** The flight modes that telemetry reports. */
public final class FlightModesTest {
    private static Telemetry frame(String flightMode, String control) {
        return GroundBench.telemetry("{\"flight_mode\": \"" + flightMode
                + "\", \"flight_control\": " + control + "}", 0);
    }

    @Test
    public void theModeThatActsIsTheRaspberryPisWhileItFlies() {
        assertEquals("LOITER", FlightModes.acting(frame("SETPOINT", "{\"mode\": \"LOITER\"}")));
        assertEquals("LOITER", FlightModes.acting(frame("OUTPUT", "{\"mode\": \"LOITER\"}")));
        assertEquals("LOITER", FlightModes.acting(frame("RETURN", "{\"mode\": \"LOITER\"}")));
        assertEquals("OUTPUT", FlightModes.acting(frame("OUTPUT", "{\"mode\": null}")));
        assertEquals("FBW", FlightModes.acting(frame("FBW", "{\"mode\": \"LOITER\"}")));
        assertNull(FlightModes.acting(Telemetry.EMPTY));
    }

    @Test
    public void missionHasItsItemBesideIt() {
        assertEquals("MISSION 3/12", progress("MISSION", "\"item\": 3, \"count\": 12"));
        assertEquals("MISSION finished",
                progress("MISSION", "\"item\": 12, \"count\": 12, \"is_finished\": true"));
        assertEquals("MISSION", progress("MISSION", "\"item\": null, \"count\": 12"));
        assertEquals("LOITER", progress("LOITER", "\"item\": 3, \"count\": 12"));
    }

    private static String progress(String mode, String mission) {
        return FlightModes.actingWithProgress(GroundBench.telemetry(
                "{\"flight_mode\": \"SETPOINT\", \"flight_control\": {\"mode\": \"" + mode
                + "\"}, \"mission\": {" + mission + "}}", 0));
    }

    @Test
    public void returnAndLoiterAreFirstAndOfferedOnlyWhereTheAircraftOffersThem() {
        Map<String, String> modes = FlightModes.all(frame("FBW", "{\"modes\": {\"AUTO\": null, "
                + "\"GLIDE\": \"altitude\", \"LOITER\": null}, \"board_modes\": [\"FBW\"]}"));
        assertEquals(Arrays.asList("RETURN", "LOITER", "AUTO", "GLIDE", "FBW"),
                new ArrayList<>(modes.keySet()));
        assertEquals(Arrays.asList("mode_unknown", null, null, "altitude", null),
                new ArrayList<>(modes.values()));
    }

    @Test
    public void anOlderAircraftTakesAutoAndTheModesOfItsBoard() {
        Map<String, String> modes = FlightModes.all(frame("FBW", "{\"modes\": 3}"));
        assertEquals(Arrays.asList("RETURN", "LOITER", "AUTO", "RATE", "FBW"),
                new ArrayList<>(modes.keySet()));
        assertEquals("mode_unknown", modes.get("RETURN"));
        assertNull(modes.get("AUTO"));
    }

    @Test
    public void hostileListsStayBounded() {
        StringBuilder many = new StringBuilder("{\"modes\": {\"a\": null");
        for (int each = 0; each < 200; each++) {
            many.append(", \"b").append(each).append("\": \"\\u001b[31m\"");
        }
        Map<String, String> modes = FlightModes.all(frame("FBW", many + "}}"));
        assertTrue(modes.size() <= 34);
        assertEquals(-1, modes.get("b3").indexOf('\u001b'));
    }

    @Test
    public void aFallbackNamesBothModesAndTheReason() {
        assertEquals("CIRCLE replaces RETURN: navigation missing or too old",
                FlightModes.fallback(frame("SETPOINT", "{\"mode\": \"CIRCLE\", "
                + "\"selected\": \"RETURN\", \"fallback\": \"navigation\"}")));
        assertNull(FlightModes.fallback(frame("SETPOINT", "{\"fallback\": null}")));
        assertNotEquals("mode_refused", FlightModes.reason("mode_refused"));
        assertNull(FlightModes.failsafe(frame("SETPOINT", "{}")));
        assertNotEquals("no_home", FlightModes.reason("no_home"));
        assertEquals("sonar", FlightModes.reason("sonar"));
    }
}
