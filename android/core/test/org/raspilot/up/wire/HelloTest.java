package org.raspilot.up.wire;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.util.Arrays;
import java.util.Map;
import org.junit.Test;

public final class HelloTest {
    private static final String TOKEN = "00112233445566778899aabbccddeeff";

    @Test
    public void goldenLinesAreWritten() throws Exception {
        int written = 0;
        for (Map<String, Object> vector : Vectors.read("proxy_hello.json")) {
            String line = (String) vector.get("line");
            if (vector.get("seat") != null && line.endsWith(" packed=1 attitude=1\n")) {
                assertEquals(line, Vectors.text(Hello.ofGround((String) vector.get("aircraft"),
                        ProxyRole.ofWord((String) vector.get("seat")),
                        (String) vector.get("token"))));
                written++;
            }
        }
        assertTrue(written >= 2);
    }

    @Test
    public void whatCannotBeSaidIsNotMade() {
        for (String name : Arrays.asList("", "a b", "a\n", null, "a/b", ".a",
                new String(new char[33]).replace('\0', 'a'))) {
            assertThrows(name, IllegalArgumentException.class, () ->
                    Hello.ofGround(name, ProxyRole.LISTEN, null));
        }
        assertThrows(IllegalArgumentException.class, () ->
                Hello.ofGround("a", ProxyRole.AIR, null));
        assertThrows(IllegalArgumentException.class, () ->
                Hello.ofGround("a", ProxyRole.LISTEN, "xyz"));
    }

    @Test
    public void answersAreReadAndWritten() {
        HelloAnswer taken = answer("UP1 ok aircraft=glider-1 seat=command token=" + TOKEN);
        assertTrue(taken.isAccepted());
        assertEquals(ProxyRole.COMMAND, taken.role);
        assertEquals(TOKEN, taken.token);
        assertEquals(ProxyRole.AIR, answer("UP1 ok aircraft=a seat=air token=" + TOKEN).role);
        HelloAnswer refused = answer("UP1 error code=taken reason=\"in use\"");
        assertFalse(refused.isAccepted());
        assertEquals("taken", refused.code);
        assertEquals("in use", refused.reason);
    }

    @Test
    public void whatIsNoAnswerIsNone() {
        for (String line : Arrays.asList("", "UP1 ok", "UP1 ok seat=pilot token=" + TOKEN,
                "UP1 ok seat=command token=abc", "UP2 ok seat=command token=" + TOKEN,
                "UP1 error", "UP1 error code=X reason=\"\"", "UP1 seat listen",
                "UP1 ok seat=command token=" + TOKEN + "\u010d", "{\"name\": \"up.arm\"}")) {
            assertNull(line, answer(line));
        }
    }

    private static HelloAnswer answer(String line) {
        byte[] bytes = Vectors.bytes(line);
        return HelloAnswer.read(bytes, bytes.length);
    }
}
