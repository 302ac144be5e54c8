package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.fail;

import org.junit.Test;
import org.raspilot.up.wire.ProxyRole;

/** Settings are valid or not there. */
public final class GroundSettingsTest {
    @Test
    public void whatIsWrongIsSaidInASentence() {
        assertNull(GroundSettings.fault("proxy.example", 3004, "glider-1"));
        assertNull(GroundSettings.fault("fe80::1%wlan0", 3004, "glider-1"));
        assertEquals("the host is empty", GroundSettings.fault(" ", 3004, "a"));
        assertEquals("the host is empty", GroundSettings.fault(null, 3004, "a"));
        assertEquals("the host is neither a name nor an address: a b",
                GroundSettings.fault("a b", 3004, "a"));
        assertEquals("the port must be 1 to 65535, not 0", GroundSettings.fault("h", 0, "a"));
        assertEquals("the port must be 1 to 65535, not 65536",
                GroundSettings.fault("h", 65536, "a"));
        final String name = "the aircraft's name must be 1 to 32 letters, digits, '_', '.' or '-'";
        assertEquals(name, GroundSettings.fault("h", 1, ""));
        assertEquals(name, GroundSettings.fault("h", 1, null));
        assertEquals(name, GroundSettings.fault("h", 1, "a seat=command"));
    }

    @Test
    public void wrongOnesCannotBeMade() {
        try {
            new GroundSettings("h", 70000, "a", ProxyRole.LISTEN, false);
            fail("made with that port");
        } catch (IllegalArgumentException fault) {
            assertEquals("the port must be 1 to 65535, not 70000", fault.getMessage());
        }
        try {
            new GroundSettings("h", 1, "a", ProxyRole.AIR, false);
            fail("made with that seat");
        } catch (IllegalArgumentException fault) {
            assertEquals("a ground commands or listens", fault.getMessage());
        }
    }

    @Test
    public void theAddressIsWrittenAsPeopleDo() {
        assertEquals("h:1", new GroundSettings(" h ", 1, "a", ProxyRole.LISTEN, false).address());
        assertEquals("[::1]:1",
                new GroundSettings("::1", 1, "a", ProxyRole.LISTEN, false).address());
    }
}
