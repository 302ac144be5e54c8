package org.raspilot.up.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertTrue;
import static org.junit.Assert.fail;

import java.util.Arrays;
import java.util.Collections;
import org.junit.Test;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.Vectors;

public final class TypedCommandsTest {
    private static final Gains GAINS = new Gains(1, 0.5, 0);

    @Test
    public void theyAreWrittenWithTheNamesOfTheWire() {
        assertWritten("up.location.update", "{\"latitude\": 50.5, \"longitude\": 14.25}",
                new LocationCommand(50.5, 14.25, null, null, null, null));
        assertWritten("up.location.update", "{\"latitude\": 50.5, \"longitude\": 14.25,"
                + " \"altitude\": 312.5, \"accuracy\": 3.0, \"speed\": 0.5, \"bearing\": 359.0}",
                new LocationCommand(50.5, 14.25, 312.5, 3.0, 0.5, 359.0));
        assertWritten("up.altitude.change", "{\"altitude\": 300.0, \"mode\": \"actual\"}",
                new AltitudeCommand(300, "actual"));
        assertWritten("up.heading.change", "{\"heading\": 90.0, \"mode\": \"required\"}",
                new HeadingCommand(90, "required"));
        assertWritten("android.battery", "{\"level\": 87.0}", new BatteryCommand(87));
        assertWritten("up.telemetry.frequency", "{\"frequency\": 50.0}",
                new TelemetryFrequencyCommand(50));
        assertWritten("up.flight_mode.set", "{\"mode\": \"FBW\"}", new FlightModeCommand("FBW"));
        assertWritten("up.arm", "{}", new ArmCommand());
        assertWritten("up.disarm", "{}", new DisarmCommand());
        assertWritten("android.speak", "{\"text\": \"\\u010dau\"}", new SpeakCommand("\u010dau"));
        assertWritten("black_box.mark", "{\"text\": \"here\"}", new MarkCommand("here"));
        assertWritten("up.panic", "{\"panic\": true, \"delay_ms\": 150}",
                new PanicCommand(true, 150, null));
        assertWritten("up.ack", "{\"id\": \"7\"}", new AckCommand("7"));
        assertWritten("up.nack", "{\"id\": \"7\", \"code\": \"stale\", \"reason\": \"late\"}",
                new NackCommand("7", "stale", "late"));
        assertWritten("black_box.record", "{\"topic\": \"phone.light\", \"content\": {\"lux\": 3}}",
                new RecordCommand("phone.light",
                        Collections.singletonMap("lux", 3)));
        assertWritten("arduino.pids.tunings", "{\"request\": true}", PidTuningsCommand.request());
        LoopGains loop = new LoopGains(GAINS, GAINS, null);
        String gains = "{\"p\": 1.0, \"i\": 0.5, \"d\": 0.0}";
        String loopData = "{\"ailerons\": " + gains + ", \"elevator\": " + gains + "}";
        assertWritten("arduino.pids.tunings", "{\"pids\": {\"ratePIDs\": " + loopData
                + ", \"stabPIDs\": " + loopData + "}}",
                new PidTuningsCommand(new GainSet(loop, loop, null)));
    }

    @Test
    public void telemetryCarriesItsBeaconBesideItsContent() {
        TelemetryCommand telemetry =
                new TelemetryCommand(Collections.singletonMap("altitude", 3), 4711L);
        assertEquals("{\"name\": \"up.telemetry.update\", \"data\": {\"altitude\": 3},"
                + " \"id\": null, \"beacon\": 4711}\n",
                Vectors.text(telemetry.toMessage().toLine()));
    }

    @Test
    public void valuesBeyondTheirRangeAreNotMade() {
        assertRefused("latitude must be a number between -90 and 90, not NaN", () ->
                new LocationCommand(Double.NaN, 0, null, null, null, null));
        assertRefused("frequency must be a number between 20 and 10000, not 19.9", () ->
                new TelemetryFrequencyCommand(19.9));
        assertRefused("mode must be one of \"RATE\", \"FBW\", \"AUTO\", not \"ACRO\"",
                () -> new FlightModeCommand("ACRO"));
        assertRefused("text must be text of at most 200 characters, not null", () ->
                new SpeakCommand((String) null));
        assertRefused("text must not be blank", () -> new MarkCommand(" \u00a0"));
        assertRefused("topic must be words of a to z, 0 to 9 and _, joined by dots: "
                + "companion.airspeed", () ->
                        new RecordCommand("alone", Collections.emptyMap()));
        assertRefused("stabPIDs.elevator.d must be a number between 0 and 50, not 50.5",
                () -> {
                    new PidTuningsCommand(new GainSet(new LoopGains(GAINS, GAINS, null),
                            new LoopGains(GAINS, new Gains(1, 1, 50.5), null), null));
                });
        assertRefused("pids must have a rudder in both loops or in none", () -> {
            new PidTuningsCommand(new GainSet(new LoopGains(GAINS, GAINS, GAINS),
                    new LoopGains(GAINS, GAINS, null), null));
        });
    }

    @Test
    public void gainsSurviveTheWire() {
        LoopGains three = new LoopGains(GAINS, new Gains(0.1, 50, 1e-9), new Gains(2, 3, 4));
        GainSet set = new GainSet(three, three, new LoopGains(GAINS, GAINS, null));
        PidTuningsCommand sent = new PidTuningsCommand(set);
        PidTuningsCommand read = (PidTuningsCommand) CommandRegistry.builtin().read(
                sent.toMessage("7", null));
        assertEquals(set.toData(), read.gains.toData());
        assertEquals(1e-9, read.gains.rate.elevator.d, 0);
        assertEquals(4, read.gains.stabilize.rudder.d, 0);
        assertNull(read.gains.navigation.rudder);
        assertEquals("7", read.id());
    }

    @Test
    public void theSameCommandGoesUnderAnotherIdAndBeacon() {
        ArmCommand arm = new ArmCommand();
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
            CommandRegistry.builtin().register("app.other", ArmCommand.READER, "load_guard.panic");
            fail("registered");
        } catch (IllegalArgumentException fault) {
            assertEquals("the Command load_guard.panic is registered already", fault.getMessage());
        }
    }

    private static void assertWritten(String name, String data, BaseCommand command) {
        assertEquals("{\"name\": \"" + name + "\", \"data\": " + data + ", \"id\": null}\n",
                Vectors.text(command.toMessage().toLine()));
        BaseCommand read = CommandRegistry.builtin().read(command.toMessage());
        assertSame(command.getClass(), read.getClass());
        assertEquals(command.data(), read.data());
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
