package org.raspilot.up.wire;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.util.Arrays;
import org.junit.Test;
import org.raspilot.up.wire.ControlLine.Kind;

public final class ControlLineTest {
    private static final String TOKEN = "00112233445566778899aabbccddeeff";

    @Test
    public void everyLineOfTheProxyIsRead() {
        assertReads("UP1 seat asked by=3", Kind.SEAT_ASKED, 3, null);
        assertReads("UP1 seat command token=" + TOKEN, Kind.SEAT_COMMAND, null, TOKEN);
        assertReads("UP1 seat listen", Kind.SEAT_LISTEN, null, null);
        assertReads("UP1 seat holder=12", Kind.SEAT_HOLDER, 12, null);
        assertReads("UP1 seat holder=none", Kind.SEAT_HOLDER, null, null);
        assertReads("UP1 aircraft online", Kind.AIRCRAFT_ONLINE, null, null);
        assertReads("UP1 aircraft offline", Kind.AIRCRAFT_OFFLINE, null, null);
    }

    @Test
    public void theRequestsOfAGroundAreWritten() {
        assertEquals("UP1 seat request\n", Vectors.text(ControlLine.seatRequest()));
        assertEquals("UP1 seat give to=3\n", Vectors.text(ControlLine.seatGive(3)));
        assertEquals("UP1 seat release\n", Vectors.text(ControlLine.seatRelease()));
    }

    @Test
    public void whatIsNotKnownSaysNothing() {
        for (String line : Arrays.asList("", "UP1", "UP1 ", "UP1 seat", "UP1 seat holder",
                "UP1 seat request", "UP1 seat release",
                "UP1 seat give to=3", "UP1 seat holder=x", "UP1 seat holder=-1",
                "UP1 seat holder=9999999999",
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

    private static void assertReads(String line, Kind kind, Integer number, String token) {
        for (String each : Arrays.asList(line, line + " future=1")) {
            ControlLine read = read(each);
            assertEquals(kind, read.kind);
            assertEquals(number, read.number);
            assertEquals(token, read.token);
        }
    }

    private static ControlLine read(String line) {
        byte[] bytes = Vectors.bytes(line);
        return ControlLine.read(bytes, bytes.length);
    }
}
