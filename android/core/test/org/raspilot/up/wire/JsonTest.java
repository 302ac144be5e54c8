package org.raspilot.up.wire;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.math.BigInteger;
import java.util.Arrays;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Random;
import org.junit.Test;

public final class JsonTest {
    private static final long SEED = 20261121L;

    @Test
    public void valuesAreWhatTheyAreInPython() throws Exception {
        assertEquals(7L, Json.parse(" 7 "));
        assertEquals(0L, Json.parse("-0"));
        assertEquals(-0.0, Json.parse("-0.0"));
        assertEquals(Long.MIN_VALUE, Json.parse("-9223372036854775808"));
        assertEquals(new BigInteger("9223372036854775808"), Json.parse("9223372036854775808"));
        assertEquals(1e300, Json.parse("1E+300"));
        assertEquals(0.0, Json.parse("1e-999"));
        assertEquals("\u010d\ud83d\ude00\n/", Json.parse("\"\\u010d\\ud83d\\uDE00\\n\\/\""));
        assertEquals("\u007f", Json.parse("\"\u007f\""));
        assertNull(Json.parse("null"));
        assertEquals(Arrays.asList(true, false, Collections.emptyList()),
                Json.parse("[true,false , [ ]]"));
    }

    @Test
    public void anObjectKeepsTheOrderOfItsKeys() throws Exception {
        Map<?, ?> read = (Map<?, ?>) Json.parse("{\"b\": 1, \"a\": {}}");
        assertEquals("[b, a]", read.keySet().toString());
    }

    @Test
    public void whatIsNoJsonIsRefused() {
        for (String text : Arrays.asList("", " ", "{", "}", "[1,]", "[,1]", "{\"a\":1,}", "{a:1}",
                "{\"a\"}", "{\"a\" 1}", "'a'", "\"", "\"\\x\"", "\"\\u12g4\"", "\"\\u123", "\"\t\"",
                "\"\\u\u0661\u0661\u0661\u0661\"", "01", "1.", ".5", "1e", "+1", "-", "--1", "0x1",
                "\u0661", "tru", "True", "nul", "1 2", "[1 2]", "\u00a01", "\ufeff1", "1\u0000",
                "1f", "1d", "[1}", "{\"a\":1]")) {
            assertRefused(text, "not_json");
        }
    }

    @Test
    public void whatTheProtocolForbidsIsRefused() {
        assertRefused("NaN", "not_a_number");
        assertRefused("[-Infinity]", "not_a_number");
        assertRefused("{\"x\": 1e999}", "number_too_large");
        assertRefused("123456789012345678901", "number_too_long");
        assertRefused("{\"a\": 1, \"\\u0061\": 2}", "repeated_key");
        assertRefused("\"\\ud800\"", "lone_surrogate");
        assertRefused("{\"\\udc00\": 1}", "lone_surrogate");
        assertRefused("\"\\udc00\\ud800\"", "lone_surrogate");
    }

    @Test
    public void nestingEndsAtThirtyTwo() throws Exception {
        Json.parse(nested(32));
        assertRefused(nested(33), "too_deep");
        assertRefused(nested(100000), "too_deep");
        Object deep = Json.parse(nested(32));
        assertEquals(nested(32), Json.write(deep));
        assertThrows(IllegalArgumentException.class, () ->
                Json.write(Collections.singletonList(deep)));
    }

    @Test
    public void textIsWrittenAsPythonWritesIt() {
        assertEquals("\"\\\"\\\\/\\b\\f\\n\\r\\t\\u0000\\u001f \\u007f~\\u010d\\ud83d\\ude00\"",
                Json.write("\"\\/\b\f\n\r\t\u0000\u001f \u007f~\u010d\ud83d\ude00"));
        Map<String, Object> fields = new LinkedHashMap<>();
        fields.put("a", Arrays.asList(1, 2L, true, null));
        fields.put("b", new LinkedHashMap<>());
        fields.put("c", Collections.emptyList());
        assertEquals("{\"a\": [1, 2, true, null], \"b\": {}, \"c\": []}", Json.write(fields));
    }

    @Test
    public void numbersAreWrittenAsPythonWritesThem() {
        Object[][] wanted = {
            {0.1, "0.1"}, {5.0, "5.0"}, {-0.0, "-0.0"}, {1e15, "1000000000000000.0"},
            {1e16, "1e+16"}, {9999999999999998.0, "9999999999999998.0"}, {1.5e-5, "1.5e-05"},
            {0.0001, "0.0001"}, {1e-300, "1e-300"}, {2e-3, "0.002"}, {1.0E23, "1e+23"},
            {2.0E-322, "2e-322"}, {Double.MIN_VALUE, "5e-324"}, {1.23e100, "1.23e+100"},
            {Double.MAX_VALUE, "1.7976931348623157e+308"}, {2.2250738585072014E-308,
                "2.2250738585072014e-308"}, {9007199254740992.0, "9007199254740992.0"},
            {1.7800590868057611E-307, "1.7800590868057611e-307"}, {4.35, "4.35"}, {100, "100"},
            {2.8480945388892178E-306, "2.848094538889218e-306"}, {50.0755, "50.0755"},
        };
        for (Object[] each : wanted) {
            assertEquals(each[1], Json.write(each[0]));
        }
    }

    @Test
    public void whatIsWrittenIsReadBack() throws Exception {
        System.out.println("seed " + SEED);
        Random random = new Random(SEED);
        for (int i = 0; i < 5000; i++) {
            Object value = RandomJson.value(random, 4);
            assertEquals(value, Json.parse(Json.write(value)));
        }
        for (int i = 0; i < 5000; i++) {
            double number = Double.longBitsToDouble(random.nextLong());
            if (!Double.isNaN(number) && !Double.isInfinite(number)) {
                assertEquals(number, Json.parse(Json.write(number)));
            }
        }
    }

    @Test
    public void whatCannotBeWrittenIsNamedByItsPlace() {
        Map<String, Object> fields = new LinkedHashMap<>();
        fields.put("good", 1);
        fields.put("x", Arrays.<Object>asList(1, Double.NaN));
        assertUnwritable("x[1]", fields);
        fields.put("x", Collections.singletonMap("y", "\ud800"));
        assertUnwritable("x.y", fields);
        fields.put("x", new StringBuilder());
        assertUnwritable("x", fields);
        assertUnwritable("the value", Double.POSITIVE_INFINITY);
        assertUnwritable("the value", Collections.singletonMap(1, 2));
    }

    private static void assertUnwritable(String place, Object value) {
        String said = assertThrows(IllegalArgumentException.class, () -> Json.write(value))
                .getMessage();
        assertTrue(said, said.startsWith(place + " "));
    }

    private static void assertRefused(String text, String code) {
        assertEquals(text, code,
                assertThrows(MalformedException.class, () -> Json.parse(text)).code);
    }

    private static String nested(int depth) {
        char[] opening = new char[depth];
        char[] closing = new char[depth];
        Arrays.fill(opening, '[');
        Arrays.fill(closing, ']');
        return new String(opening) + new String(closing);
    }
}
