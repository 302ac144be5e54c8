package org.raspilot.up.airborne;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import java.util.ArrayList;
import java.util.List;
import org.junit.After;
import org.junit.Before;
import org.junit.Test;
import org.raspilot.up.commands.BaseCommand;

/** What the phone does with the Commands that come, and what it answers. */
public final class AirborneCommandsTest {
    private final AirborneBench bench = new AirborneBench();
    private Airborne airborne;

    @Before
    public void connect() {
        airborne = bench.connected(AirborneBench.fixed().build());
    }

    @After
    public void nothingThrew() {
        bench.faults.mustBeNone();
    }

    @Test
    public void aTextIsSaidAndAcknowledged() {
        bench.hear("{\"name\": \"android.speak\", \"data\": {\"text\": \"land now\"}, "
                + "\"id\": \"7\"}");
        assertEquals("[land now]", bench.said.toString());
        assertEquals("[{\"name\": \"up.ack\", \"data\": {\"id\": \"7\"}, \"id\": null}]",
                bench.lines().toString());
    }

    @Test
    public void telemetryIsCountedAndGoesToWhoRegisters() {
        final List<BaseCommand> frames = new ArrayList<>();
        airborne.up().commandExecutor().registerCommand("up.telemetry.update",
                command -> frames.add(command));
        bench.hear("{\"name\": \"up.telemetry.update\", \"data\": {\"altitude\": 5.0}, "
                + "\"beacon\": 12}");
        assertEquals(1, airborne.status().counters.telemetry);
        assertEquals(5.0, frames.get(0).data().get("altitude"));
        assertEquals("[]", bench.lines().toString());
    }

    @Test
    public void aHandlerThatFailsIsToldAndRefusesOnlyItsOwn() {
        airborne.up().commandExecutor().registerCommand("my.own", command -> {
            throw new IllegalStateException("a mistake");
        });
        bench.hear("{\"name\": \"my.own\", \"data\": {}, \"id\": \"1\"}");
        bench.hear("{\"name\": \"android.speak\", \"data\": {\"text\": \"hi\"}}");
        assertTrue(bench.lines().toString().contains("\"code\": \"failed\""));
        assertTrue(bench.events.contains("handler_failed"));
        assertEquals("[hi]", bench.said.toString());
    }

    @Test
    public void whatTheRaspberryPiRefusesIsShownWithoutWhatWouldHarmAScreen() {
        StringBuilder reason = new StringBuilder("no\\u202e way\\u0007");
        for (int i = 0; i < 400; i++) {
            reason.append('x');
        }
        bench.hear("{\"name\": \"up.nack\", \"data\": {\"id\": \"9\", \"code\": \"refused\","
                + " \"reason\": \"" + reason + "\"}}");
        String told = bench.sentences.get(bench.sentences.size() - 1);
        assertTrue(told, told.contains(": no wayxxx"));
        assertTrue(told, told.endsWith("x\u2026"));
        assertTrue(told, told.length() < 350);
    }

    @Test
    public void panicComesUnderBothNamesAndIsAcknowledged() {
        for (String name : new String[] {"up.panic", "load_guard.panic"}) {
            bench.hear("{\"name\": \"" + name + "\", \"data\": {\"panic\": true, "
                    + "\"delay_ms\": 150}, \"id\": \"" + name + "\"}");
            assertEquals(150, airborne.status().panicDelayMs);
            assertEquals(1, AirborneBench.count(bench.lines(), "up.ack"));
            bench.hear("{\"name\": \"up.panic\", \"data\": {\"panic\": false, "
                    + "\"delay_ms\": 150}}");
            assertEquals(0, airborne.status().panicDelayMs);
        }
        assertEquals("[connected 10.0.0.1:50001:50000, panic 150, panic 0, panic 150, panic 0]",
                bench.events.toString());
    }

    @Test
    public void aPanicThatIsNoneIsRefused() {
        String[] datas = {"{}", "{\"panic\": true}", "{\"panic\": 1, \"delay_ms\": 150}",
            "{\"panic\": true, \"delay_ms\": -1}", "{\"panic\": true, \"delay_ms\": 10001}",
            "{\"panic\": true, \"delay_ms\": \"150\"}", "{\"panic\": true, \"delay_ms\": true}"};
        for (int at = 0; at < datas.length; at++) {
            bench.hear("{\"name\": \"up.panic\", \"data\": " + datas[at] + ", \"id\": \"" + at
                    + "\"}");
            String answer = bench.lines().toString();
            assertTrue(datas[at] + answer, answer.contains("\"code\": \"invalid\""));
        }
        assertEquals(0, airborne.status().panicDelayMs);
        assertEquals(datas.length, airborne.status().counters.refused);
    }
}
