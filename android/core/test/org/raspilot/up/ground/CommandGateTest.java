package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.io.File;
import java.util.Collections;
import java.util.HashMap;
import java.util.Map;
import org.junit.Before;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.commands.CommandCatalogue;
import org.raspilot.up.ground.CommandGate.DisabledReason;
import org.raspilot.up.wire.ProxyRole;
import org.raspilot.up.wire.Vectors;

/** What the gate offers; what it sends is in GroundCommandsTest. */
public final class CommandGateTest {
    private static final Map<String, Object> NOTHING = Collections.emptyMap();
    private static final Map<String, Object> REQUEST =
            Collections.singletonMap("request", true);

    @Rule
    public final GroundBench bench = new GroundBench();
    private CommandCatalogue installed;

    @Before
    public void readCatalogue() throws Exception {
        File root = new File(System.getProperty("vectors")).getParentFile().getParentFile();
        installed = CommandCatalogue.read(
                Vectors.text(new File(root, "android/raspilot/assets/commands.json")));
    }

    @Test
    public void aRoleMayWhatTheOnesBeforeMay() {
        assertTrue(CommandGate.allows("pilot", "operator"));
        assertTrue(CommandGate.allows("operator", "operator"));
        assertFalse(CommandGate.allows("operator", "pilot"));
        assertFalse(CommandGate.allows("observer", "operator"));
    }

    @Test
    public void aRoleThatNobodyKnowsIsNoObjection() {
        assertTrue(CommandGate.allows(null, "pilot"));
        assertTrue(CommandGate.allows("captain", "pilot"));
    }

    @Test
    public void aRequestIsAnyObserversAndTheRestNeedsItsRole() {
        assertTrue(isOnlyRequest("arduino.profile.request", NOTHING));
        assertTrue(isOnlyRequest("arduino.pids.tunings", REQUEST));
        assertFalse(isOnlyRequest("arduino.pids.tunings", NOTHING));
        assertFalse(isOnlyRequest("up.arm", REQUEST));
        assertEquals("pilot", installed.form("arduino.pids.tunings").role(NOTHING));
    }

    private boolean isOnlyRequest(String name, Map<String, ?> data) {
        return CommandGate.isOnlyRequest(installed.form(name), data);
    }

    @Test
    public void withoutAServiceNothingIsOffered() {
        assertEquals(DisabledReason.NO_LINK, CommandGate.objection(
                installed.form("up.arm"), NOTHING, null, Telemetry.EMPTY, 0));
    }

    @Test
    public void aRequestNeedsNoTelemetryAndACommandTheRole() {
        bench.open(ProxyRole.COMMAND);
        assertEquals(DisabledReason.SILENT, objection("up.disarm", NOTHING));
        assertEquals(DisabledReason.NONE, objection("arduino.pids.tunings", REQUEST));
        bench.frame(1, "{\"ground\": {\"role\": \"operator\"}}");
        assertEquals(DisabledReason.ROLE, objection("up.disarm", NOTHING));
        assertEquals(DisabledReason.ROLE, objection("arduino.pids.tunings", NOTHING));
        assertEquals(DisabledReason.NONE, objection("arduino.pids.tunings", REQUEST));
        assertEquals(DisabledReason.NONE, objection("up.flight_mode.set", NOTHING));
    }

    private DisabledReason objection(String name, Map<String, ?> data) {
        return CommandGate.objection(installed.form(name), data, bench.ground.status(),
                bench.ground.telemetry(), bench.loop.nowMs());
    }

    @Test
    public void theMotorsStateDecidesWhatIsLeftToAsk() {
        assertEquals(DisabledReason.ARMED_ALREADY, CommandGate.ofMotor("up.arm", true, null));
        assertEquals(DisabledReason.NONE, CommandGate.ofMotor("up.arm", false, null));
        assertEquals(DisabledReason.DISARMED_ALREADY,
                CommandGate.ofMotor("up.disarm", false, null));
        assertEquals(DisabledReason.NONE, CommandGate.ofMotor("up.disarm", true, null));
        assertEquals(DisabledReason.NONE, CommandGate.ofMotor("up.arm", null, null));
    }

    private static DisabledReason ofAircraft(String name, Boolean isArmed, long flightAgeMs,
            long nowMs) {
        Map<String, Object> data = new HashMap<>();
        data.put("armed", isArmed);
        data.put("age_ms", Collections.singletonMap("flight", flightAgeMs));
        Telemetry frame = Telemetry.of(data, 7L, 10000, 0);
        return CommandGate.ofAircraft(name, null, frame, nowMs);
    }

    @Test
    public void nobodyCommandsWhatTheyDoNotSee() {
        assertEquals(DisabledReason.NONE, ofAircraft("up.arm", false, 100, 10500));
        assertEquals(DisabledReason.SILENT, ofAircraft("up.arm", false, 100, 11000));
    }

    @Test
    public void aMotorsStateThatIsOldIsNoState() {
        assertEquals(DisabledReason.ARMED_ALREADY, ofAircraft("up.arm", true, 100, 10500));
        assertEquals(DisabledReason.NONE, ofAircraft("up.arm", true, 5000, 10500));
    }

    @Test
    public void gainsAreRefusedInFlightWhereTheAircraftSaysSo() {
        String name = "arduino.pids.tunings";
        assertEquals(DisabledReason.ARMED, CommandGate.ofMotor(name, true, false));
        assertEquals(DisabledReason.NONE, CommandGate.ofMotor(name, true, true));
        assertEquals(DisabledReason.NONE, CommandGate.ofMotor(name, true, null));
        assertEquals(DisabledReason.NONE, CommandGate.ofMotor(name, false, false));
        Map<String, Object> data = new HashMap<>();
        data.put("armed", false);
        data.put("in_flight", true);
        data.put("age_ms", Collections.singletonMap("flight", 100L));
        Telemetry glider = Telemetry.of(data, 7L, 10000, 0);
        assertEquals(DisabledReason.ARMED,
                CommandGate.ofAircraft(name, false, glider, 10500));
        assertEquals(DisabledReason.NONE,
                CommandGate.ofAircraft("up.arm", false, glider, 10500));
    }
}
