package org.raspilot.up.wire;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;
import static org.junit.Assert.fail;

import java.util.Arrays;
import java.util.List;
import java.util.Map;
import org.junit.Test;

public final class HelloTest {
    private static final String TOKEN = "00112233445566778899aabbccddeeff";

    @Test
    public void goldenLinesAreReadAndWritten() throws Exception {
        List<Map<String, Object>> vectors = Vectors.read("proxy_hello.json");
        assertTrue(vectors.size() >= 10);
        for (Map<String, Object> vector : vectors) {
            String line = (String) vector.get("line");
            boolean isGround = vector.get("side").equals("ground");
            if (vector.containsKey("error")) {
                assertMalformed(line, isGround);
                continue;
            }
            Hello hello = read(line, isGround);
            assertEquals(vector.get("aircraft"), hello.aircraft);
            assertEquals(vector.get("token"), hello.token);
            Object seat = vector.get("seat");
            assertEquals(seat == null ? null : ProxyRole.ofWord((String) seat), hello.role);
            if (!line.contains("future")) {
                assertEquals(line, Vectors.text(hello.toLine()));
            }
        }
    }

    @Test
    public void aGroundThatNamesNoSeatAsksToCommand() throws Exception {
        assertEquals(ProxyRole.COMMAND, read("UP1 aircraft=a\n", true).role);
        assertNull(read("UP1 aircraft=a", false).role);
    }

    @Test
    public void whatIsNoHelloIsRefused() {
        for (String line : Arrays.asList("", "\n", "UP1\n", "UP1 \n", "UP1  aircraft=a\n",
                "UP1 aircraft=a \n", "UP1 aircraft=a aircraft=b\n", "UP1 aircraft=a\u0000\n",
                "UP1 aircraft=a word\n", "UP1 aircraft=a =1\n", "UP1 aircraft=a x=\u010d\n",
                "UP1 aircraft=" + new String(new char[33]).replace('\0', 'a') + "\n",
                "UP1 aircraft=a seat=air\n", "UP1 aircraft=a token=\n",
                "UP1 aircraft=a x=" + new String(new char[512]).replace('\0', 'a') + "\n")) {
            assertMalformed(line, true);
        }
        assertMalformed("UP1 aircraft=a seat=command\n", false);
    }

    @Test
    public void whatCannotBeSaidIsNotMade() {
        for (String name : Arrays.asList("", "a b", "a\n", null)) {
            try {
                Hello.ofAircraft(name, null);
                fail("made with " + name);
            } catch (IllegalArgumentException fault) {
                assertTrue(fault.getMessage(), fault.getMessage().contains("name"));
            }
        }
        try {
            Hello.ofGround("a", ProxyRole.AIR, null);
            fail("made");
        } catch (IllegalArgumentException fault) {
            assertTrue(fault.getMessage(), fault.getMessage().contains("command or to listen"));
        }
        try {
            Hello.ofAircraft("a", "xyz");
            fail("made");
        } catch (IllegalArgumentException fault) {
            assertTrue(fault.getMessage(), fault.getMessage().contains("token"));
        }
    }

    @Test
    public void answersAreReadAndWritten() {
        HelloAnswer taken = answer("UP1 ok aircraft=glider-1 seat=command token=" + TOKEN);
        assertTrue(taken.isAccepted());
        assertEquals(ProxyRole.COMMAND, taken.role);
        assertEquals(TOKEN, taken.token);
        assertEquals("glider-1", taken.aircraft);
        assertEquals("UP1 ok aircraft=glider-1 seat=command token=" + TOKEN + "\n",
                Vectors.text(taken.toLine()));
        assertEquals(ProxyRole.AIR, answer("UP1 ok aircraft=a seat=air token=" + TOKEN).role);
        HelloAnswer refused = answer("UP1 error code=taken reason=\"the name is in use\"");
        assertFalse(refused.isAccepted());
        assertEquals("taken", refused.code);
        assertEquals("the name is in use", refused.reason);
        assertEquals("UP1 error code=taken reason=\"the name is in use\"\n",
                Vectors.text(refused.toLine()));
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

    private static Hello read(String line, boolean isGround) throws MalformedException {
        byte[] bytes = Vectors.bytes(line);
        return Hello.read(bytes, bytes.length, isGround);
    }

    private static void assertMalformed(String line, boolean isGround) {
        try {
            read(line, isGround);
            fail("read: " + line);
        } catch (MalformedException fault) {
            assertTrue(fault.reason().length() > 0);
        }
    }
}
