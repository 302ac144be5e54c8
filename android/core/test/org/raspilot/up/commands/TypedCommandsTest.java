package org.raspilot.up.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertThrows;
import static org.raspilot.up.commands.CommandFormTest.assertRefused;

import java.util.Collections;
import org.junit.Test;
import org.raspilot.up.commands.GainSet.Gains;
import org.raspilot.up.commands.GainSet.LoopGains;
import org.raspilot.up.wire.GeneralMessage;

public final class TypedCommandsTest {
    private static final Gains GAINS = new Gains(1, 0.5, 0);

    @Test
    public void valuesBeyondTheirRangeAreNotMade() {
        assertRefused("out_of_range latitude", () ->
                Commands.of(Commands.LOCATION, "latitude", Double.NaN, "longitude", 0L));
        assertRefused("out_of_range frequency", () ->
                Commands.of(Commands.TELEMETRY_PERIOD, "frequency", 19.9));
        assertRefused("missing mode", () -> Commands.flightMode(null));
        assertRefused("missing text", () -> Commands.of(Commands.SPEAK, "text", null));
        assertRefused("empty text", () -> Commands.of(Commands.MARK, "text", " \u00a0"));
        assertRefused("malformed topic", () -> Commands.record("alone", Collections.emptyMap()));
    }

    @Test
    public void gainsSurviveTheWire() {
        LoopGains three = new LoopGains(GAINS, new Gains(0.1, 50, 1e-9), new Gains(2, 3, 4));
        GainSet set = new GainSet(three, three);
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
    }

    @Test
    public void aNameIsRegisteredOnce() {
        assertThrows(IllegalArgumentException.class, () -> CommandRegistry.builtin().register(
                "app.other", message -> new BaseCommand(message), "load_guard.panic"));
    }
}
