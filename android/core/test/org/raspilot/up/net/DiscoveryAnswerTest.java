package org.raspilot.up.net;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertTrue;

import java.nio.charset.Charset;
import java.util.Random;
import org.junit.Test;

public final class DiscoveryAnswerTest {
    @Test
    public void theTextIsTheAddress() {
        assertEquals("192.168.43.7", read("192.168.43.7", "192.168.43.9"));
        assertEquals("10.0.0.1", read(" 10.0.0.1\r\n", "192.168.43.9"));
        assertEquals("127.0.0.1", read("127.0.0.1", "127.0.0.1"));
    }

    @Test
    public void anEmptyAnswerComesFromTheAddress() {
        assertEquals("192.168.43.9", read("", "192.168.43.9"));
        assertEquals("192.168.43.9", read("\n", "192.168.43.9"));
    }

    @Test
    public void whatNoHostCanHaveIsNoAnswer() {
        final String[] wrong = {"raspberry.local", "1.2.3", "1.2.3.4.5", "256.1.1.1", "0.0.0.0",
            "224.0.0.1", "255.255.255.255", "127.0.0.1", "010.1.1.1", "1.1.1.-1", "::1", "1..1.1",
            "99999999999.1.1.1", "10.0.0.1 10.0.0.2", "\u00e4"};
        for (String each : wrong) {
            assertNull(each, read(each, "192.168.43.9"));
        }
        final StringBuilder longOne = new StringBuilder("10.0.0.1");
        while (longOne.length() <= 64) {
            longOne.append(' ');
        }
        assertNull(read(longOne.toString(), "192.168.43.9"));
    }

    @Test
    public void noBytesBreakIt() {
        final long seed = System.nanoTime();
        final Random random = new Random(seed);
        final byte[] letters = "0123456789.. \n".getBytes(Charset.forName("US-ASCII"));
        for (int i = 0; i < 20000; i++) {
            final byte[] bytes = new byte[random.nextInt(20)];
            random.nextBytes(bytes);
            for (int j = 0; i % 2 == 0 && j < bytes.length; j++) {
                bytes[j] = letters[random.nextInt(letters.length)];
            }
            final String found = DiscoveryAnswer.read(bytes, bytes.length, "192.168.43.9");
            assertTrue("seed " + seed + ": " + found,
                    found == null || found.matches("[0-9]+(\\.[0-9]+){3}"));
        }
    }

    private static String read(String text, String source) {
        final byte[] bytes = text.getBytes(Charset.forName("UTF-8"));
        return DiscoveryAnswer.read(bytes, bytes.length, source);
    }
}
