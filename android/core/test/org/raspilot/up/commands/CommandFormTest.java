package org.raspilot.up.commands;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.io.File;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.junit.Before;
import org.junit.Test;
import org.junit.function.ThrowingRunnable;
import org.raspilot.up.wire.GeneralMessage;
import org.raspilot.up.wire.MalformedException;
import org.raspilot.up.wire.Vectors;

/** Fills in the forms that the app shows. */
public final class CommandFormTest {
    private static final String ALL_TYPES = "{\"type\": \"catalogue\", \"commands\": [{"
            + "\"name\": \"app.all\", \"aliases\": [\"app.old\"], \"role\": \"operator\","
            + " \"role_where\": [],"
            + " \"text\": \"All of them.\", \"needs_beacon\": true, \"fields\": ["
            + field("flag", "boolean", "null", "null", "null", "null", "true or false")
            + field("count", "integer", "1", "9", "null", "null", "a whole number from 1 to 9")
            + field("size", "number", "-1", "null", "null", "null", "a number of at least -1 m")
            + field("gear", "integer", "null", "null", "[1, 2]", "null", "one of 1, 2")
            + field("word", "text", "null", "null", "null", "3", "text of at most 3 characters")
            + field("tree", "object", "null", "null", "null", "1", "a map of at most 1 keys")
            + field("row", "list", "null", "null", "null", "null", "a list")
            + "{\"name\": \"must\", \"type\": \"number\", \"unit\": \"s\", \"minimum\": null,"
            + " \"maximum\": null, \"choices\": null, \"max_length\": null, \"nullable\": false,"
            + " \"required\": true, \"text\": \"a number (s)\"}]}]}";

    private CommandCatalogue installed;
    private CommandForm all;

    @Before
    public void readCatalogues() throws Exception {
        File root = new File(System.getProperty("vectors")).getParentFile().getParentFile();
        installed = CommandCatalogue.read(
                Vectors.text(new File(root, "android/raspilot/assets/commands.json")));
        all = CommandCatalogue.read(ALL_TYPES).form("app.old");
    }

    @Test
    public void theCatalogueOfTheAppIsRead() {
        CommandForm arm = installed.form("up.arm");
        assertEquals("pilot", arm.role(Collections.<String, Object>emptyMap()));
        assertEquals(0, arm.fields().size());
        CommandField period = installed.form("up.telemetry.frequency").field("frequency");
        assertEquals("ms", period.unit);
        assertEquals(Double.valueOf(20), period.minimum);
        assertEquals(Double.valueOf(10000), period.maximum);
        assertTrue(period.isRequired());
        assertEquals(Integer.valueOf(32),
                installed.form("up.flight_mode.set").field("mode").maxLength);
        assertEquals(Integer.valueOf(200),
                installed.form("android.speak").field("text").maxLength);
        assertNull(installed.form("up.location.update"));
    }

    /** The typed Commands and the catalogue come from two hands: their bounds are the same. */
    @Test
    public void typedCommandsAgreeWithTheirForms() {
        int compared = 0;
        for (CommandForm form : installed.forms()) {
            CommandRegistry registry = CommandRegistry.builtin();
            if (!registry.knows(form.name) || form.field("pids") != null) {
                continue;
            }
            for (CommandField field : form.fields()) {
                for (Object value : values(field)) {
                    Map<String, Object> data = new LinkedHashMap<>();
                    for (CommandField other : form.fields()) {
                        data.put(other.name, other == field ? value : good(other));
                    }
                    assertEquals(form.name + " " + data, isValid(() -> form.check(data)),
                            isValid(() -> registry.read(
                                    new GeneralMessage(form.name, data))));
                    compared++;
                }
            }
        }
        assertTrue("compared " + compared, compared > 40);
    }

    @Test
    public void whatAPersonTypesBecomesData() {
        assertParsed("{must=3}", "must", "3", "flag", "", "word", "  ");
        assertParsed("{must=-3.5, flag=true, count=9}", "must", " -3.5 ", "flag", "Yes", "count",
                "+9");
        assertParsed("{must=3, flag=null}", "must", "3", "flag", "null");
        assertParsed("{must=1, gear=2, word= b }", "must", "1", "gear", "2", "word", " b ");
        assertParsed("{must=1, tree={a=[1, null]}, row=[]}", "must", "1", "tree",
                "{\"a\": [1, null]}", "row", "[]");
        assertSame(Long.class, all.parse(inputs("must", "3")).get("must").getClass());
    }

    @Test
    public void eachErrorHasACodeAndNamesTheField() {
        assertRefused("missing must");
        assertParsed("{must=1.5}", "must", "1,5");
        assertParsed("{must=-0.125}", "must", "-0,125");
        assertParsed("{must=48.1481}", "must", "48,1481");
        for (String typed : Arrays.asList("1,5,5", "1,000", "1,000.5", "NaN", "null", "1e999",
                "0x10")) {
            assertRefused("wrong_type must", "must", typed);
        }
        assertRefused("wrong_type flag", "flag", "maybe", "must", "1");
        assertRefused("out_of_range count", "count", "10");
        assertRefused("wrong_type count", "count", "2.5");
        assertRefused("wrong_type count", "count", "99999999999999999999");
        assertRefused("out_of_range size", "size", "-1.01");
        assertRefused("unknown_choice gear", "gear", "3");
        assertRefused("too_long word", "word", "abcd");
        assertRefused("wrong_type tree", "tree", "{a: 1}");
        assertRefused("wrong_type tree", "tree", "[1]");
        assertRefused("too_long tree", "tree", "{\"a\": 1, \"b\": 2}");
        assertRefused("unknown wing", "wing", "1", "must", "1");
        InvalidCommandException fault = assertThrows(InvalidCommandException.class, () ->
                all.parse(inputs("count", "10")));
        assertEquals("count must be a whole number from 1 to 9, not 10", fault.getMessage());
    }

    @Test
    public void aCommandIsCheckedAsAWhole() {
        BaseCommand mode = installed.form("up.flight_mode.set").command(inputs("mode", "FBW"));
        assertEquals("FBW", mode.data().get("mode"));
        CommandForm gains = installed.form("arduino.pids.tunings");
        assertEquals(true, gains.command(inputs("request", "true")).data().get("request"));
        assertRefused("missing pids", () -> gains.command(inputs()));
        assertRefused("missing pids.ratePIDs", () -> gains.command(inputs("pids", "{}")));
        assertEquals("app.all", all.command(inputs("must", "3")).name());
    }

    @Test
    public void whatIsNoCatalogueIsRefused() {
        for (String text : Arrays.asList("", "[]", "{}", "{\"commands\": [1]}",
                "{\"commands\": [{\"name\": \"a\"}]}", ALL_TYPES.replace("\"list\"", "\"tuple\""),
                ALL_TYPES.replace("\"unit\": \"s\"", "\"unit\": 5"))) {
            assertThrows(text, MalformedException.class, () -> CommandCatalogue.read(text));
        }
    }

    private static String field(String name, String type, String minimum, String maximum,
            String choices, String maxLength, String text) {
        return "{\"name\": \"" + name + "\", \"type\": \"" + type + "\", \"unit\": \"\","
                + " \"minimum\": " + minimum + ", \"maximum\": " + maximum + ", \"choices\": "
                + choices + ", \"max_length\": " + maxLength + ", \"nullable\": true,"
                + " \"required\": false, \"text\": \"" + text + "\"}, ";
    }

    private void assertParsed(String wanted, String... typed) {
        assertEquals(wanted, all.parse(inputs(typed)).toString());
    }

    private void assertRefused(String codeAndField, String... typed) {
        assertRefused(codeAndField, () -> all.parse(inputs(typed)));
    }

    static void assertRefused(String codeAndField, ThrowingRunnable call) {
        InvalidCommandException fault = assertThrows(InvalidCommandException.class, call);
        assertEquals(codeAndField, fault.code + " " + fault.field);
    }

    private static Map<String, String> inputs(String... typed) {
        Map<String, String> inputs = new LinkedHashMap<>();
        for (int i = 0; i < typed.length; i += 2) {
            inputs.put(typed[i], typed[i + 1]);
        }
        return inputs;
    }

    private static boolean isValid(Runnable check) {
        try {
            check.run();
            return true;
        } catch (InvalidCommandException fault) {
            return false;
        }
    }

    private static Object good(CommandField field) {
        if (field.choices != null) {
            return field.choices.get(0);
        }
        return field.type == FieldType.TEXT ? (Object) "text" : field.minimum;
    }

    private static List<Object> values(CommandField field) {
        List<Object> values = new ArrayList<>(Arrays.<Object>asList(null, true, 0L, 0.5,
                "no such choice", Collections.emptyList(), Collections.emptyMap(), good(field)));
        for (Double bound : Arrays.asList(field.minimum, field.maximum)) {
            if (bound != null) {
                values.addAll(Arrays.asList(bound, Math.nextUp(bound), -Math.nextUp(-bound),
                        bound + 1, bound - 1, bound.longValue()));
            }
        }
        if (field.maxLength != null) {
            String longest = new String(new char[field.maxLength]).replace('\0', 'x');
            values.addAll(Arrays.asList(longest, longest + "x"));
        }
        return values;
    }
}
