package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;

import java.util.Collections;
import org.junit.Test;
import org.raspilot.up.commands.BaseCommand;

/** Commands in words, by the titles that their classes declare. */
public final class CommandTextsTest {
    private static String of(String name, String field, Object value) {
        return CommandTexts.of(new BaseCommand(name, Collections.singletonMap(field, value)));
    }

    @Test
    public void aTitleHasTheValueOfTheOnlyField() {
        assertEquals("Flight mode FBW", of("up.flight_mode.set", "mode", "FBW"));
        assertEquals("Calibrate gyroscope bias", of("arduino.calibrate", "what", "gyroscope_bias"));
        assertEquals("Speak \"$1 {}\"", of("android.speak", "text", "$1 {}"));
        assertEquals("Gains", of("arduino.pids.tunings", "request", true));
        assertEquals("some.cog.thing", of("some.cog.thing", "x", 1));
    }

    @Test
    public void aTitleStandsAlone() {
        assertEquals("Telemetry period", CommandTexts.title("up.telemetry.frequency"));
        assertEquals("Mark", CommandTexts.title("black_box.mark"));
        assertEquals("Set home", CommandTexts.title("up.home.set"));
        assertEquals("some.cog.thing", CommandTexts.title("some.cog.thing"));
    }
}
