package org.raspilot.up.wire;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;
import static org.junit.Assert.fail;

import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.Map;
import org.junit.Test;
import org.raspilot.up.wire.ControlLine.Kind;

public final class ControlLineTest {
    private static final String TOKEN = "00112233445566778899aabbccddeeff";

    @Test
    public void everyLineOfTheProtocolIsReadAndWritten() {
        Map<String, ControlLine> lines = new LinkedHashMap<>();
        lines.put("UP1 seat request", ControlLine.of(Kind.SEAT_REQUEST));
        lines.put("UP1 seat asked by=3", ControlLine.of(Kind.SEAT_ASKED, 3));
        lines.put("UP1 seat give to=3", ControlLine.of(Kind.SEAT_GIVE, 3));
        lines.put("UP1 seat release", ControlLine.of(Kind.SEAT_RELEASE));
        lines.put("UP1 seat command token=" + TOKEN, ControlLine.seatCommand(TOKEN));
        lines.put("UP1 seat listen", ControlLine.of(Kind.SEAT_LISTEN));
        lines.put("UP1 seat holder=12", ControlLine.of(Kind.SEAT_HOLDER, 12));
        lines.put("UP1 seat holder=none", ControlLine.of(Kind.SEAT_HOLDER));
        lines.put("UP1 aircraft online", ControlLine.of(Kind.AIRCRAFT_ONLINE));
        lines.put("UP1 aircraft offline", ControlLine.of(Kind.AIRCRAFT_OFFLINE));
        for (Map.Entry<String, ControlLine> each : lines.entrySet()) {
            assertEquals(each.getKey() + "\n", Vectors.text(each.getValue().toLine()));
            assertReads(each.getKey(), each.getValue());
            assertReads(each.getKey() + " future=1", each.getValue());
        }
    }

    @Test
    public void whatIsNotKnownSaysNothing() {
        for (String line : Arrays.asList("", "UP1", "UP1 ", "UP1 seat", "UP1 seat holder",
                "UP1 seat holder=x", "UP1 seat holder=-1", "UP1 seat holder=9999999999",
                "UP1 seat asked", "UP1 seat command", "UP1 seat command token=xyz", "UP1 aircraft",
                "UP1 aircraft gone", "UP2 seat listen", "UP1 seat listen\u0007",
                "UP1 ok seat=listen token=" + TOKEN, "\u010d")) {
            assertNull(line, read(line));
        }
    }

    @Test
    public void theyAreToldFromMessages() {
        byte[] line = Vectors.bytes("UP1 seat listen");
        assertTrue(ControlLine.isControlLine(line, line.length));
        assertFalse(ControlLine.isControlLine(line, 3));
        byte[] message = Vectors.bytes("{\"name\": \"UP1 \"}");
        assertFalse(ControlLine.isControlLine(message, message.length));
    }

    @Test
    public void whatCannotBeSaidIsNotMade() {
        for (Kind kind : Arrays.asList(Kind.SEAT_ASKED, Kind.SEAT_GIVE, Kind.SEAT_COMMAND)) {
            try {
                ControlLine.of(kind);
                fail("made " + kind);
            } catch (IllegalArgumentException fault) {
                assertTrue(fault.getMessage().contains("needs a number or a token"));
            }
        }
        try {
            ControlLine.of(Kind.SEAT_LISTEN, 3);
            fail("made");
        } catch (IllegalArgumentException fault) {
            assertTrue(fault.getMessage().contains("has no number"));
        }
    }

    private static void assertReads(String line, ControlLine wanted) {
        ControlLine read = read(line);
        assertEquals(wanted.kind, read.kind);
        assertEquals(wanted.number, read.number);
        assertEquals(wanted.token, read.token);
    }

    private static ControlLine read(String line) {
        byte[] bytes = Vectors.bytes(line);
        return ControlLine.read(bytes, bytes.length);
    }
}
