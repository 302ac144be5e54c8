package org.raspilot.up.net;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;
import static org.junit.Assert.fail;

import java.util.Collections;
import java.util.Map;
import java.util.Random;
import org.junit.Test;

public final class RunnerAnswerTest {
    private static final String ANSWER = "{\"message\": \"Raspilot spawned\", \"spawned\": true,"
            + " \"error\": null, \"myAddress\": \"203.0.113.9\", \"running\": true, \"pid\": 4242,"
            + " \"instance\": \"glider-1\","
            + " \"ports\": {\"general\": 50001, \"orientation\": 50000},"
            + " \"proxy\": {\"host\": \"proxy.example\", \"airborne\": 3003, \"ground\": 3004}}";

    @Test
    public void theAnswerOfTheProtocolIsUnderstood() throws Exception {
        final RunnerAnswer answer = RunnerAnswer.read(ANSWER, "runner.example");
        assertEquals(new Endpoint("runner.example", 50001, 50000), answer.endpoint);
        assertEquals("Raspilot spawned", answer.message);
        assertNull(answer.error);
        assertTrue(answer.isSpawned);
        assertEquals("glider-1", answer.instance);
        assertEquals("proxy.example", answer.proxyHost);
        assertEquals(3004, answer.proxyGroundPort);
    }

    @Test
    public void anInstanceThatRunsOtherwiseThanAskedIsAPlaceWithAnError() throws Exception {
        final RunnerAnswer answer = RunnerAnswer.read("{\"running\": true, \"spawned\": false,"
                + " \"error\": \"another configuration runs\", \"proxy\": null,"
                + " \"ports\": {\"general\": 1, \"orientation\": 65535}}", "h");
        assertEquals("another configuration runs", answer.error);
        assertFalse(answer.isSpawned);
        assertNull(answer.message);
        assertNull(answer.proxyHost);
        assertEquals(0, answer.proxyGroundPort);
    }

    @Test
    public void aRefusalIsTheRunnersSentence() {
        assertEquals("the runner says: no free ports",
                refusal("{\"running\": false, \"message\": \"m\", \"error\": \"no free ports\"}"));
        assertEquals("the runner says: Raspilot not running",
                refusal("{\"running\": false, \"message\": \"Raspilot not running\"}"));
        assertEquals("the runner says: nothing runs", refusal("{\"running\": false}"));
    }

    @Test
    public void aRefusalOfManyWordsIsCutForTheScreen() {
        final StringBuilder words = new StringBuilder();
        for (int i = 0; i < 1000; i++) {
            words.append("no ");
        }
        assertEquals("the runner says: ".length() + 200,
                refusal("{\"running\": false, \"error\": \"" + words + "\"}").length());
        assertEquals("the runner says: no way",
                refusal("{\"running\": false, \"error\": \"no\\u202e way\\u0007\"}"));
    }

    @Test
    public void portsThatAreNoneAreNoPlace() {
        final String[] wrong = {"0", "65536", "-1", "1.5", "50001.0", "\"50001\"", "null", "true",
            "99999999999999999999", "{}"};
        for (String port : wrong) {
            for (String ports : new String[] {
                "{\"general\": " + port + ", \"orientation\": 50000}",
                "{\"general\": 50001, \"orientation\": " + port + "}"}) {
                assertEquals(ports, "the runner's answer names no ports of 1 to 65535",
                        refusal("{\"running\": true, \"ports\": " + ports + "}"));
            }
        }
        for (String ports : new String[] {"null", "[50001, 50000]", "{}", "1"}) {
            assertEquals(ports, "the runner's answer names no ports of 1 to 65535",
                    refusal("{\"running\": true, \"ports\": " + ports + "}"));
        }
    }

    @Test
    public void whatIsNoAnswerIsASentence() {
        for (String line : new String[] {"", "HTTP/1.1 400 Bad Request", "[]", "null", "{}",
            "{\"running\": 1}", "{\"running\": \"true\"}", ANSWER + "x", "{\"running\": true"}) {
            assertTrue(line, refusal(line).startsWith("the runner's answer is not understood: "));
        }
    }

    @Test
    public void noBytesBreakIt() {
        final long seed = System.nanoTime();
        final Random random = new Random(seed);
        for (int i = 0; i < 10000; i++) {
            final StringBuilder line = new StringBuilder(ANSWER);
            for (int j = random.nextInt(4); j >= 0; j--) {
                final int at = random.nextInt(line.length());
                switch (random.nextInt(3)) {
                    case 0:
                        line.setCharAt(at, (char) random.nextInt(128));
                        break;
                    case 1:
                        line.deleteCharAt(at);
                        break;
                    default:
                        line.insert(at, "{}[]:,\"0-e".charAt(random.nextInt(10)));
                }
            }
            try {
                final Endpoint place = RunnerAnswer.read(line.toString(), "h").endpoint;
                assertTrue(place.generalPort >= 1 && place.orientationPort >= 1);
            } catch (RunnerAnswer.RefusedException expected) {
                assertFalse("seed " + seed, expected.getMessage().isEmpty());
            } catch (RuntimeException error) {
                throw new AssertionError("seed " + seed + ": " + line, error);
            }
        }
    }

    @Test
    public void aRequestNamesWhatIsAsked() throws Exception {
        assertEquals("{\"aircraft\": \"glider-1\"}\n", line("glider-1", null, null));
        final Map<String, ?> configuration = Collections.singletonMap("load_guard.yml",
                Collections.singletonMap("interval", 1.0));
        assertEquals("{\"aircraft\": \"a\", \"profile\": \"easyglider\", \"configuration\":"
                + " {\"load_guard.yml\": {\"interval\": 1.0}}}\n",
                line("a", "easyglider", configuration));
    }

    @Test
    public void aNameThatIsNoneIsNotAsked() {
        for (String name : new String[] {null, "", ".hidden", "a b", "a\n", "a/b", "\u00e4",
            "x12345678901234567890123456789012"}) {
            try {
                new RunnerRequest(name, null, null);
                fail("asked for " + name);
            } catch (IllegalArgumentException expected) {
                assertTrue(expected.getMessage().startsWith("the aircraft's name must be"));
            }
        }
    }

    @Test
    public void aRequestThatNoRunnerReadsIsNotMade() {
        final String much = new String(new char[65536]).replace('\0', 'x');
        try {
            new RunnerRequest("a", null, Collections.singletonMap("a.yml", much));
            fail("it was made");
        } catch (IllegalArgumentException expected) {
            assertTrue(expected.getMessage().startsWith("the request has 65"));
        }
    }

    private static String line(String aircraft, String profile, Map<String, ?> configuration)
            throws Exception {
        return new String(new RunnerRequest(aircraft, profile, configuration).toLine(), "UTF-8");
    }

    private static String refusal(String line) {
        try {
            RunnerAnswer.read(line, "h");
        } catch (RunnerAnswer.RefusedException refusal) {
            return refusal.getMessage();
        }
        throw new AssertionError("taken: " + line);
    }
}
