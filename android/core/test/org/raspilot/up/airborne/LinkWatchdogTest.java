package org.raspilot.up.airborne;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.util.List;
import org.junit.After;
import org.junit.Test;

/** A dead connection is noticed, and a quiet peer is not taken for a dead one. */
public final class LinkWatchdogTest {
    private final AirborneBench bench = new AirborneBench();

    @After
    public void nothingThrew() {
        bench.faults.mustBeNone();
    }

    @Test
    public void aPeerThatAnswersAndThenSaysNothingIsLeft() {
        bench.connected(AirborneBench.fixed().build());
        answerTheId();
        bench.fly(20, 2500);
        assertTrue(bench.airborne.status().isConnected);
        bench.fly(20, 1500);
        assertFalse(bench.airborne.status().isConnected);
        assertTrue(bench.events.contains("lost: silent"));
    }

    @Test
    public void aPeerThatAnswersEachIdIsKeptHoweverQuietItIs() {
        bench.connected(AirborneBench.fixed().build());
        for (int at = 0; at < 60; at++) {
            answerTheId();
            bench.fly(20, 1200);
        }
        assertTrue(bench.airborne.status().isConnected);
        assertEquals(1, bench.airborne.status().counters.connections);
    }

    @Test
    public void aPeerThatSendsTelemetryIsAskedOnceOnly() {
        bench.connected(AirborneBench.fixed().build());
        answerTheId();
        int asked = 0;
        for (int at = 0; at < 100; at++) {
            bench.fly(20, 500);
            for (String line : bench.lines()) {
                asked += line.endsWith("\"id\": null}") ? 0 : 1;
            }
            bench.hear("{\"name\": \"up.telemetry.update\", \"data\": {}}");
        }
        assertEquals(0, asked);
        assertTrue(bench.airborne.status().isConnected);
    }

    @Test
    public void anOldPeerThatNeverAnswersIsKept() {
        bench.connected(AirborneBench.fixed().build());
        bench.fly(20, 60000);
        assertTrue(bench.airborne.status().isConnected);
    }

    @Test
    public void withNothingToSendNobodyIsJudged() {
        bench.connected(AirborneBench.fixed().build());
        answerTheId();
        bench.loop.advance(60000);
        // The battery's level is repeated each ten seconds, with an id.
        assertFalse(bench.airborne.status().isConnected);
        AirborneBench quiet = new AirborneBench();
        quiet.connected(AirborneBench.fixed().build());
        quiet.loop.advance(60000);
        assertTrue(quiet.airborne.status().isConnected);
    }

    @Test
    public void aRefusalIsAnAnswerAndIsTold() {
        bench.connected(AirborneBench.fixed().build());
        bench.fly(20, 20);
        String id = id(bench.lines());
        bench.hear("{\"name\": \"up.nack\", \"data\": {\"id\": \"" + id
                + "\", \"code\": \"forbidden\", \"reason\": \"no sensor\"}}");
        assertTrue(bench.events.contains("nack_received"));
        bench.fly(20, 4000);
        assertFalse(bench.airborne.status().isConnected);
    }

    @Test
    public void idsOfTwoConnectionsDiffer() {
        bench.connected(AirborneBench.fixed().build());
        bench.fly(20, 20);
        String first = id(bench.lines());
        bench.general().end("gone");
        bench.loop.advance(5000);
        bench.accept(50001);
        bench.fly(20, 20);
        assertFalse(first.equals(id(bench.lines())));
    }

    private void answerTheId() {
        bench.fly(20, 20);
        String id = id(bench.lines());
        bench.hear("{\"name\": \"up.ack\", \"data\": {\"id\": \"" + id + "\"}}");
    }

    private static String id(List<String> lines) {
        for (String line : lines) {
            if (!line.endsWith("\"id\": null}")) {
                return line.replaceAll(".*\"id\": \"", "").replace("\"}", "");
            }
        }
        throw new AssertionError("no id in " + lines);
    }
}
