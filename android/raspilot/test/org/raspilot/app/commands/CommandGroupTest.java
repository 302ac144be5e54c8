package org.raspilot.app.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.util.Collections;
import org.junit.Test;
import org.raspilot.up.commands.CommandCatalogue;

public final class CommandGroupTest {
    private static boolean isConfirmed(String name, String role) throws Exception {
        String json = "{\"commands\": [{\"name\": \"" + name + "\", \"aliases\": [],"
                + " \"role\": \"" + role + "\", \"role_where\": [], \"text\": \"\","
                + " \"needs_beacon\": false, \"fields\": []}]}";
        return CommandGroup.isConfirmed(CommandCatalogue.read(json).form(name),
                Collections.<String, Object>emptyMap());
    }

    @Test
    public void whatChangesTheFlightIsConfirmedAndWhatNobodyKnowsToo() throws Exception {
        assertTrue(isConfirmed("up.heading.change", "operator"));
        assertTrue(isConfirmed("up.flight_mode.set", "operator"));
        assertTrue(isConfirmed("arduino.calibrate", "operator"));
        assertTrue(isConfirmed("chute.open", "operator"));
        assertTrue(isConfirmed("android.reboot", "operator"));
        assertFalse(isConfirmed("android.speak", "operator"));
        assertFalse(isConfirmed("up.telemetry.frequency", "operator"));
        assertFalse(isConfirmed("black_box.mark", "operator"));
        assertFalse(isConfirmed("arduino.profile.request", "observer"));
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
