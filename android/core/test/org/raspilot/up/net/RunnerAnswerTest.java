package org.raspilot.up.net;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

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
        assertEquals("proxy.example", answer.proxyHost);
        assertEquals(3004, answer.proxyGroundPort);
    }

    @Test
    public void aPoolNamesTheHostOfTheInstance() throws Exception {
        final RunnerAnswer answer = RunnerAnswer.read("{\"running\": true, \"host\": \"10.0.0.2\","
                + " \"ports\": {\"general\": 50001, \"orientation\": 50000}}", "10.0.0.1");
        assertEquals(new Endpoint("10.0.0.2", 50001, 50000), answer.endpoint);
    }

    @Test
    public void anInstanceThatRunsOtherwiseThanAskedIsAPlaceWithAnError() throws Exception {
        final RunnerAnswer answer = RunnerAnswer.read("{\"running\": true, \"spawned\": false,"
                + " \"error\": \"another configuration\", \"proxy\": null,"
                + " \"ports\": {\"general\": 1, \"orientation\": 65535}}", "h");
        assertEquals("another configuration", answer.error);
        assertNull(answer.message);
        assertNull(answer.proxyHost);
        assertEquals(0, answer.proxyGroundPort);
    }

    @Test
    public void aRefusalIsTheRunnersSentence() {
        assertRefused("refused", "no ports",
                "{\"running\": false, \"message\": \"m\", \"error\": \"no ports\"}");
        assertRefused("refused", "not running",
                "{\"running\": false, \"message\": \"not running\"}");
        assertRefused("refused", "", "{\"running\": false}");
        assertRefused("refused", ": no way",
                "{\"running\": false, \"error\": \"no\\u202e way\\u0007\"}");
    }

    @Test
    public void aRefusalOfManyWordsIsCutForTheScreen() {
        String words = new String(new char[3000]).replace('\0', 'x');
        String cut = new String(new char[199]).replace('\0', 'x') + "\u2026";
        assertRefused("refused", ": " + cut, "{\"running\": false, \"error\": \"" + words + "\"}");
    }

    @Test
    public void portsThatAreNoneAreNoPlace() {
        final String[] wrong = {"0", "65536", "-1", "1.5", "50001.0", "\"50001\"", "null", "true",
            "99999999999999999999", "{}"};
        for (String port : wrong) {
            for (String ports : new String[] {
                "{\"general\": " + port + ", \"orientation\": 50000}",
                "{\"general\": 50001, \"orientation\": " + port + "}"}) {
                assertRefused("no_ports", "", "{\"running\": true, \"ports\": " + ports + "}");
            }
        }
        for (String ports : new String[] {"null", "[50001, 50000]", "{}", "1"}) {
            assertRefused("no_ports", "", "{\"running\": true, \"ports\": " + ports + "}");
        }
    }

    @Test
    public void whatIsNoAnswerIsASentence() {
        for (String line : new String[] {"", "HTTP/1.1 400 Bad Request", "[]", "null", "{}",
            "{\"running\": 1}", "{\"running\": \"true\"}", ANSWER + "x", "{\"running\": true"}) {
            assertRefused("not_understood", "", line);
        }
    }

    @Test
    public void aRequestNamesWhatIsAsked() throws Exception {
        assertEquals("{\"aircraft\": \"glider-1\"}", new RunnerRequest("glider-1", "", null).json);
        assertEquals("{\"aircraft\": \"a\", \"profile\": \"easyglider\"}",
                new RunnerRequest("a", "easyglider", null).json);
    }

    @Test
    public void aNameThatIsNoneIsNotAsked() {
        for (String name : new String[] {null, "", ".hidden", "a b", "a\n", "a/b", "\u00e4",
            "x12345678901234567890123456789012"}) {
            assertThrows(name, IllegalArgumentException.class, () ->
                    new RunnerRequest(name, "", null));
        }
    }

    private static void assertRefused(String code, String end, String line) {
        RunnerAnswer.RefusedException refusal = assertThrows(line,
                RunnerAnswer.RefusedException.class, () -> RunnerAnswer.read(line, "h"));
        assertEquals(line, code, refusal.code);
        assertTrue(refusal.getMessage(), refusal.getMessage().endsWith(end));
    }
}
