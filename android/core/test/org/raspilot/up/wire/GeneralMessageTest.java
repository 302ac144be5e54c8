package org.raspilot.up.wire;

import static org.junit.Assert.assertArrayEquals;
import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.Random;
import org.junit.Test;

public final class GeneralMessageTest {
    private static final long SEED = 4711L;
    private static final int MUTATIONS = 10000;

    @Test
    public void goldenLinesAreWrittenExactly() throws Exception {
        List<Map<String, Object>> vectors = Vectors.read("general_message.json");
        assertTrue(vectors.size() >= 5);
        for (Map<String, Object> vector : vectors) {
            GeneralMessage message = new GeneralMessage((String) vector.get("name"),
                    fields(vector.get("data")), (String) vector.get("id"),
                    (Long) vector.get("beacon"));
            assertEquals(vector.get("line"), Vectors.text(message.toLine()));
            assertReads(vector);
        }
    }

    @Test
    public void goldenLinesAreReadOrRefused() throws Exception {
        List<Map<String, Object>> vectors = Vectors.read("general_message_read.json");
        assertTrue(vectors.size() >= 17);
        for (Map<String, Object> vector : vectors) {
            if (vector.containsKey("malformed")) {
                assertMalformed((String) vector.get("line"), null);
            } else {
                assertReads(vector);
            }
        }
    }

    @Test
    public void theIdOfAFaultyMessageIsToldWhereItCanBeRead() throws Exception {
        assertMalformed("{\"id\": \"a\", \"name\": 3}", "a");
        assertMalformed("{\"id\": 7, \"name\": \"x\", \"data\": NaN}", "7");
        assertMalformed("{\"id\": 1e16, \"name\": \"x\", \"beacon\": 1.0}", "1e+16");
        assertMalformed("{\"id\": \"a\", \"name\": \"x\", \"name\": \"y\"}", "a");
        assertMalformed("{\"id\": \"a\", \"id\": \"b\", \"name\": \"x\"}", null);
        assertMalformed("{\"id\": \"a\", \"name\": \"x\"", null);
        assertMalformed("{\"id\": true, \"name\": \"x\"}", null);
        assertMalformed("{\"id\": \"\", \"name\": \"x\"}", null);
        assertMalformed("{\"id\": \"a\", \"name\": \"\\ud800\"}", "a");
        assertMalformed("{\"id\": \"\\ud800\", \"name\": \"x\"}", null);
        assertMalformed("{\"id\": 123456789012345678901, \"name\": \"x\"}",
                "123456789012345678901");
        assertMalformed("{\"id\": \"a\", \"name\": \"x\", \"beacon\": 9223372036854775808}", "a");
        assertMalformed("{\"id\": \"a\", \"data\": " + repeated("[", 40) + repeated("]", 40) + "}",
                "a");
    }

    @Test
    public void lengthsAreCountedInCharacters() throws Exception {
        String name = repeated("\ud83d\ude00", 128);
        assertEquals(name, read("{\"name\": \"" + name + "\"}").name);
        assertMalformed("{\"name\": \"" + name + "a\"}", null);
        String id = repeated("\ud83d\ude00", 64);
        assertEquals(id, read("{\"name\": \"a\", \"id\": \"" + id + "\"}").id);
        assertMalformed("{\"name\": \"a\", \"id\": \"" + id + "a\"}", null);
    }

    @Test
    public void bytesThatAreNoUtf8AreRefused() throws Exception {
        for (byte[] wrong : Arrays.asList(new byte[] {(byte) 0xff}, new byte[] {(byte) 0xc0, 0x41},
                new byte[] {(byte) 0xed, (byte) 0xa0, (byte) 0x80}, new byte[] {(byte) 0xe2})) {
            byte[] line = Vectors.bytes("{\"name\": \"####\"}");
            System.arraycopy(wrong, 0, line, 10, wrong.length);
            assertEquals("not_utf8", assertThrows(MalformedException.class, () ->
                    GeneralMessage.read(line, line.length)).code);
        }
    }

    @Test
    public void aLineHasAtMostSixteenKibibytes() throws Exception {
        int frame = new GeneralMessage("a", Collections.singletonMap("x", "")).toLine().length;
        GeneralMessage longest = new GeneralMessage("a",
                Collections.singletonMap("x", repeated("y", LineSplitter.MAX_LINE_BYTES - frame)));
        byte[] line = longest.toLine();
        assertEquals(LineSplitter.MAX_LINE_BYTES, line.length);
        assertEquals(longest.data, GeneralMessage.read(line, line.length).data);
        GeneralMessage tooLong = new GeneralMessage("a", Collections.singletonMap("x",
                repeated("y", LineSplitter.MAX_LINE_BYTES - frame + 1)));
        assertThrows(IllegalArgumentException.class, () -> tooLong.toLine());
        byte[] longer = Arrays.copyOf(line, line.length + 1);
        longer[line.length] = ' ';
        assertEquals("too_long", assertThrows(MalformedException.class, () ->
                GeneralMessage.read(longer, longer.length)).code);
    }

    @Test
    public void dataCannotBeChangedAtAnyDepth() throws Exception {
        GeneralMessage message = read("{\"name\": \"a\", \"data\": {\"x\": [{}]}}");
        assertThrows(UnsupportedOperationException.class, () ->
                fields(((List<?>) message.data.get("x")).get(0)).put("y", 1));
    }

    @Test
    public void everyMessageIsReadBack() throws Exception {
        System.out.println("seed " + SEED);
        Random random = new Random(SEED);
        for (int i = 0; i < 5000; i++) {
            GeneralMessage message = RandomMessage.of(random);
            byte[] line = message.toLine();
            GeneralMessage read = GeneralMessage.read(line, line.length);
            assertEquals(message.name, read.name);
            assertEquals(message.data, read.data);
            assertEquals(message.id, read.id);
            assertEquals(message.beacon, read.beacon);
            assertArrayEquals(line, read.toLine());
        }
    }

    /** Whatever a line is: a message that can be written again, or a MalformedException. */
    @Test
    public void aDamagedLineIsAMessageOrMalformed() {
        System.out.println("seed " + SEED);
        Random random = new Random(SEED);
        int read = 0;
        for (int i = 0; i < MUTATIONS; i++) {
            byte[] line = RandomMessage.damaged(random);
            try {
                GeneralMessage message = GeneralMessage.read(line, line.length);
                assertTrue(message.toLine().length > 0);
                read++;
            } catch (MalformedException fault) {
                assertTrue(fault.reason().length() > 0);
            }
        }
        // Both must happen, or this shows nothing.
        assertTrue("read " + read, read > MUTATIONS / 50 && read < MUTATIONS * 49 / 50);
    }

    private static void assertReads(Map<String, Object> vector) throws Exception {
        GeneralMessage message = read((String) vector.get("line"));
        assertEquals(vector.get("name"), message.name);
        assertEquals(vector.get("data"), message.data);
        assertEquals(vector.get("id"), message.id);
        assertEquals(vector.get("beacon"), message.beacon);
    }

    private static void assertMalformed(String line, String id) {
        assertEquals(line, id, assertThrows(MalformedException.class, () -> read(line)).id);
    }

    private static GeneralMessage read(String line) throws MalformedException {
        byte[] bytes = Vectors.bytes(line);
        return GeneralMessage.read(bytes, bytes.length);
    }

    private static String repeated(String text, int count) {
        StringBuilder all = new StringBuilder();
        for (int i = 0; i < count; i++) {
            all.append(text);
        }
        return all.toString();
    }

    @SuppressWarnings("unchecked")
    private static Map<String, Object> fields(Object value) {
        return (Map<String, Object>) value;
    }
}
