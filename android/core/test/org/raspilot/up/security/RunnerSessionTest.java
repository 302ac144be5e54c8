package org.raspilot.up.security;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;

import java.io.File;
import java.util.Arrays;
import java.util.Map;
import java.util.Random;
import org.junit.Before;
import org.junit.Test;
import org.raspilot.up.wire.Json;
import org.raspilot.up.wire.Vectors;

/** A request to a runner under a key: golden vectors, and answers that must not be accepted. */
public final class RunnerSessionTest {
    private static final String REQUEST = "{\"aircraft\": \"glider-1\"}";

    private final RunnerSession session = new RunnerSession(
            Pairing.parse(TestAircraft.TEXT.replace(":glider:", ":glider-1:")), new Random() {
                private static final long serialVersionUID = 1L;

                @Override
                public void nextBytes(byte[] bytes) {
                    Arrays.fill(bytes, (byte) 0x11);
                }
            });
    private Map<?, ?> lines;

    @Before
    public void read() throws Exception {
        lines = (Map<?, ?>) ((Map<?, ?>) Json.parse(Vectors.text(
                new File(System.getProperty("vectors"), "runner_request.json")))).get("lines");
    }

    private String line(String name) {
        return (String) lines.get(name);
    }

    private static void refused(String code, String line, Taker taker) {
        assertEquals(line, code,
                assertThrows(line, EnvelopeException.class, () -> taker.take(line)).code);
    }

    private interface Taker {
        void take(String line) throws EnvelopeException;
    }

    @Test
    public void theGoldenVectors() throws Exception {
        assertEquals(line("hello"), session.hello());
        assertEquals(line("request"), session.request(line("answer"), REQUEST));
        assertEquals("{\"running\": true}", session.result(line("result")));
    }

    @Test
    public void whatProvesNothingIsRefusedWithACode() throws Exception {
        session.hello();
        refused("unknown_key", line("refusal"), line -> session.request(line, REQUEST));
        refused("malformed", line("result"), line -> session.request(line, REQUEST));
        refused("protection_off", "{\"running\": false, \"code\": \"protection_off\"}",
                line -> session.request(line, REQUEST));
        refused("malformed", "{\"code\": \"<b>Words</b>\"}", line -> session.request(line, REQUEST));
        session.request(line("answer"), REQUEST);
        refused("malformed", line("answer"), line -> session.result(line));
        refused("forged", line("request"), line -> session.result(line));
        refused("forged", line("result").replace("7d", "7e"), line -> session.result(line));
        for (String plain : new String[] {"{\"running\": true, \"ports\": {}, \"code\": null}",
            "{\"action\": \"protected\", \"body\": \"zz\"}",
            "{\"action\": \"protected\", \"body\": \"020\"}",
            "{\"action\": \"protected\", \"body\": \"\"}"}) {
            refused("unprotected", plain, line -> session.result(line));
        }
        for (String other : new String[] {"{\"body\": \"02\"}", "{\"body\": \"7b\"}", "[]", ""}) {
            refused("malformed", other, line -> session.result(line));
        }
        session.result(line("result"));
        refused("replayed", line("result"), line -> session.result(line));
        refused("unknown_key", line("refusal"), line -> session.result(line));
    }
}
