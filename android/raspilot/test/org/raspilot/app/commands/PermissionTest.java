package org.raspilot.app.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.util.Collections;
import java.util.HashMap;
import java.util.Map;
import org.junit.Test;
import org.raspilot.app.commands.Permission.DisabledReason;
import org.raspilot.up.ground.Telemetry;

public final class PermissionTest {
    private static final Map<String, Object> NOTHING = Collections.emptyMap();
    private static final Map<String, Object> REQUEST =
            Collections.singletonMap("request", true);

    @Test
    public void aRoleMayWhatTheOnesBeforeMay() {
        assertTrue(Permission.allows("pilot", "operator"));
        assertTrue(Permission.allows("operator", "operator"));
        assertFalse(Permission.allows("operator", "pilot"));
        assertFalse(Permission.allows("observer", "operator"));
    }

    @Test
    public void aRoleThatNobodyKnowsIsNoObjection() {
        assertTrue(Permission.allows(null, "pilot"));
        assertTrue(Permission.allows("captain", "pilot"));
    }

    @Test
    public void whatDependsIsDecidedByItsFields() {
        assertEquals("observer",
                Permission.neededRole("arduino.pids.tunings", "depends", REQUEST));
        assertEquals("pilot", Permission.neededRole("arduino.pids.tunings", "depends", NOTHING));
        assertEquals("operator",
                Permission.neededRole("up.heading.change", "depends", NOTHING));
        assertEquals("pilot", Permission.neededRole("up.arm", "pilot", NOTHING));
    }

    @Test
    public void onlyARequestAsksForNothingElse() {
        assertTrue(Permission.isOnlyRequest("arduino.profile.request", NOTHING));
        assertTrue(Permission.isOnlyRequest("arduino.pids.tunings", REQUEST));
        assertFalse(Permission.isOnlyRequest("arduino.pids.tunings", NOTHING));
        assertFalse(Permission.isOnlyRequest("up.arm", REQUEST));
    }

    @Test
    public void withoutAServiceNothingIsOffered() {
        assertEquals(DisabledReason.NO_LINK, Permission.ofLink(null));
    }

    @Test
    public void theMotorsStateDecidesWhatIsLeftToAsk() {
        assertEquals(DisabledReason.ARMED_ALREADY, Permission.ofMotor("up.arm", true, null));
        assertEquals(DisabledReason.NONE, Permission.ofMotor("up.arm", false, null));
        assertEquals(DisabledReason.DISARMED_ALREADY, Permission.ofMotor("up.disarm", false, null));
        assertEquals(DisabledReason.NONE, Permission.ofMotor("up.disarm", true, null));
        assertEquals(DisabledReason.NONE, Permission.ofMotor("up.arm", null, null));
    }

    private static DisabledReason ofAircraft(String name, Boolean isArmed, long flightAgeMs,
            long nowMs) {
        Map<String, Object> data = new HashMap<>();
        data.put("armed", isArmed);
        data.put("age_ms", Collections.singletonMap("flight", flightAgeMs));
        Telemetry frame = Telemetry.of(data, 7L, 10000, 0);
        return Permission.ofAircraft(name, NOTHING, null, frame, nowMs);
    }

    @Test
    public void nobodyCommandsWhatTheyDoNotSee() {
        assertEquals(DisabledReason.NONE, ofAircraft("up.arm", false, 100, 10500));
        assertEquals(DisabledReason.SILENT, ofAircraft("up.arm", false, 100, 11000));
        assertEquals(DisabledReason.SILENT,
                Permission.ofAircraft("up.heading.change", NOTHING, null,
                Telemetry.EMPTY, 0));
        assertEquals(DisabledReason.NONE,
                Permission.ofAircraft("arduino.pids.tunings", REQUEST, null,
                Telemetry.EMPTY, 0));
    }

    @Test
    public void aMotorsStateThatIsOldIsNoState() {
        assertEquals(DisabledReason.ARMED_ALREADY, ofAircraft("up.arm", true, 100, 10500));
        assertEquals(DisabledReason.NONE, ofAircraft("up.arm", true, 5000, 10500));
    }

    @Test
    public void gainsAreRefusedInFlightWhereTheAircraftSaysSo() {
        String name = "arduino.pids.tunings";
        assertEquals(DisabledReason.ARMED, Permission.ofMotor(name, true, false));
        assertEquals(DisabledReason.NONE, Permission.ofMotor(name, true, true));
        assertEquals(DisabledReason.NONE, Permission.ofMotor(name, true, null));
        assertEquals(DisabledReason.NONE, Permission.ofMotor(name, false, false));
        Map<String, Object> data = new HashMap<>();
        data.put("armed", false);
        data.put("in_flight", true);
        data.put("age_ms", Collections.singletonMap("flight", 100L));
        Telemetry glider = Telemetry.of(data, 7L, 10000, 0);
        assertEquals(DisabledReason.ARMED,
                Permission.ofAircraft(name, NOTHING, false, glider, 10500));
        assertEquals(DisabledReason.NONE,
                Permission.ofAircraft("up.arm", NOTHING, false, glider, 10500));
    }

    @Test
    public void whatChangesTheFlightIsConfirmedAndWhatNobodyKnowsToo() {
        assertTrue(Permission.isConfirmed("up.heading.change", NOTHING));
        assertTrue(Permission.isConfirmed("up.flight_mode.set", NOTHING));
        assertTrue(Permission.isConfirmed("arduino.calibrate", NOTHING));
        assertTrue(Permission.isConfirmed("chute.open", NOTHING));
        assertTrue(Permission.isConfirmed("android.reboot", NOTHING));
        assertFalse(Permission.isConfirmed("android.speak", NOTHING));
        assertFalse(Permission.isConfirmed("up.telemetry.frequency", NOTHING));
        assertFalse(Permission.isConfirmed("black_box.mark", NOTHING));
        assertFalse(Permission.isConfirmed("arduino.profile.request", NOTHING));
    }

    @Test
    public void commandsAreFoundByWordsInAnyOrder() {
        assertTrue(CommandGroup.matches("mode FLIGHT", "up.flight_mode.set", "A flight mode"));
        assertTrue(CommandGroup.matches("", "anything"));
        assertTrue(CommandGroup.matches("  arm ", "up.arm"));
        assertFalse(CommandGroup.matches("arm glider", "up.arm", "Arms the motor"));
    }

    @Test
    public void everyNameHasAGroup() {
        assertEquals(CommandGroup.FLIGHT, CommandGroup.of("up.arm"));
        assertEquals(CommandGroup.DATA, CommandGroup.of("up.telemetry.frequency"));
        assertEquals(CommandGroup.BOARD, CommandGroup.of("arduino.calibrate"));
        assertEquals(CommandGroup.PHONE, CommandGroup.of("android.speak"));
        assertEquals(CommandGroup.OTHER, CommandGroup.of("chute.open"));
    }
}
