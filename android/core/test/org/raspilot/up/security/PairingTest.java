package org.raspilot.up.security;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;

import org.junit.Test;

/** The text that `up keys add` prints, and texts that look like it. */
public final class PairingTest {
    @Test
    public void aTextIsReadAndWritten() {
        final Pairing pairing = Pairing.parse(" " + TestAircraft.TEXT + "\n");
        assertEquals("glider", pairing.aircraft);
        assertEquals("pilot", pairing.role);
        assertEquals("tablet", pairing.name);
        assertEquals(31, pairing.secret()[31]);
        assertEquals(TestAircraft.TEXT, pairing.toText());
        assertFalse(pairing.toString().contains("0001"));
    }

    @Test
    public void anotherTextIsNone() {
        for (String[] change : new String[][] {{"upkey:1", "upkey:2"}, {"0001", "000"},
            {"pilot", "king"}, {":glider:", ":.glider:"}, {":glider:", "::"}, {"1f:", "1F:"},
            {":tablet", ":a b"}, {":tablet", ""}, {":tablet", ":tablet:x"}}) {
            assertNull(change[1], Pairing.parse(
                    TestAircraft.TEXT.replace(change[0], change[1])));
        }
        assertNull(Pairing.parse(""));
    }
}
