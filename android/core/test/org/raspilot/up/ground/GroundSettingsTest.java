package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import org.junit.Test;
import org.junit.function.ThrowingRunnable;
import org.raspilot.up.wire.ProxyRole;

/** Settings are valid or not there. */
public final class GroundSettingsTest {
    @Test
    public void whatIsWrongIsNamed() {
        assertEquals("fe80::1%wlan0", settings("fe80::1%wlan0", 3004, "glider-1").host);
        for (String host : new String[] {" ", null, "a b", "h/x"}) {
            refused("host", () -> settings(host, 3004, "a"));
        }
        for (int port : new int[] {0, 65536, 70000}) {
            refused("port", () -> settings("h", port, "a"));
        }
        for (String name : new String[] {"", null, "a seat=command"}) {
            refused("aircraft's name", () -> settings("h", 1, name));
        }
        refused("seat", () -> new GroundSettings("h", 1, "a", ProxyRole.AIR, false));
    }

    private static GroundSettings settings(String host, int port, String aircraft) {
        return new GroundSettings(host, port, aircraft, ProxyRole.LISTEN, false);
    }

    private static void refused(String setting, ThrowingRunnable call) {
        final String sentence = assertThrows(IllegalArgumentException.class, call).getMessage();
        assertTrue(sentence, sentence.startsWith("the " + setting + " "));
    }
}
