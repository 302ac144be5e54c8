package org.raspilot.up.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertTrue;
import static org.junit.Assert.fail;

import java.util.Arrays;
import java.util.Collections;
import org.junit.Test;
import org.raspilot.up.commands.GainSet.Gains;
import org.raspilot.up.commands.GainSet.LoopGains;
import org.raspilot.up.wire.GeneralMessage;

public final class TypedCommandsTest {
    private static final Gains GAINS = new Gains(1, 0.5, 0);

    @Test
    public void valuesBeyondTheirRangeAreNotMade() {
        assertRefused("latitude must be a number between -90 and 90, not NaN", () ->
                Commands.of(Commands.LOCATION, "latitude", Double.NaN, "longitude", 0L));
        assertRefused("frequency must be a number between 20 and 10000, not 19.9", () ->
                Commands.of(Commands.TELEMETRY_PERIOD, "frequency", 19.9));
        assertRefused("mode must be one of \"RATE\", \"FBW\", \"AUTO\", not \"ACRO\"",
                () -> Commands.flightMode("ACRO"));
        assertRefused("text is missing", () ->
                Commands.of(Commands.SPEAK, "text", null));
        assertRefused("text must not be blank",
                () -> Commands.of(Commands.MARK, "text", " \u00a0"));
        assertRefused("topic must be words of a to z, 0 to 9 and _, joined by dots: "
                + "companion.airspeed", () ->
                        Commands.record("alone", Collections.emptyMap()));
        assertRefused("stabPIDs.elevator.d must be a number between 0 and 50, not 50.5",
                () -> {
                    Commands.pids(new GainSet(new LoopGains(GAINS, GAINS, null),
                            new LoopGains(GAINS, new Gains(1, 1, 50.5), null), null));
                });
        assertRefused("pids must have a rudder in both loops or in none", () -> {
            Commands.pids(new GainSet(new LoopGains(GAINS, GAINS, GAINS),
                    new LoopGains(GAINS, GAINS, null), null));
        });
    }

    @Test
    public void gainsSurviveTheWire() {
        LoopGains three = new LoopGains(GAINS, new Gains(0.1, 50, 1e-9), new Gains(2, 3, 4));
        GainSet set = new GainSet(three, three, new LoopGains(GAINS, GAINS, null));
        BaseCommand read = CommandRegistry.builtin().read(
                Commands.pids(set).toMessage("7", null));
        assertEquals(set.toData(), read.data().get("pids"));
        assertEquals("7", read.id());
    }

    @Test
    public void theSameCommandGoesUnderAnotherIdAndBeacon() {
        BaseCommand arm = new BaseCommand(Commands.ARM);
        GeneralMessage message = arm.toMessage("7", 4711L);
        assertEquals("7", message.id);
        assertEquals(Long.valueOf(4711), message.beacon);
        assertNull(arm.id());
        assertSame(arm.data(), message.data);
    }

    @Test
    public void codesAreWords() {
        assertEquals("no_beacon", NackCode.NO_BEACON.word());
        for (NackCode code : NackCode.values()) {
            assertSame(code, NackCode.ofWord(code.word()));
        }
        assertNull(NackCode.ofWord("NO_BEACON"));
        assertTrue(Arrays.asList(NackCode.values()).contains(NackCode.FORBIDDEN));
    }

    @Test
    public void aNameIsRegisteredOnce() {
        try {
            CommandRegistry.builtin().register("app.other", message -> new BaseCommand(message),
                    "load_guard.panic");
            fail("registered");
        } catch (IllegalArgumentException fault) {
            assertEquals("the Command load_guard.panic is registered already", fault.getMessage());
        }
    }

    private static void assertRefused(String sentence, Runnable making) {
        try {
            making.run();
            fail("made in spite of: " + sentence);
        } catch (InvalidCommandException fault) {
            assertEquals(sentence, fault.getMessage());
        }
    }
}
