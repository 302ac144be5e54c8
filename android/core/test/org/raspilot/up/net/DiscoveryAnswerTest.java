package org.raspilot.up.net;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
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
    }

    @Test
    public void anEmptyAnswerComesFromTheAddress() {
        assertEquals("192.168.43.9", read("", "192.168.43.9"));
        assertEquals("192.168.43.9", read("\n", "192.168.43.9"));
    }

    @Test
    public void anotherTextIsNoAnswer() {
        final String[] wrong = {"raspberry.local", "1.2.3", "1.2.3.4.5", "1.1.1.-1", "::1",
            "1..1.1", "99999999999.1.1.1", "10.0.0.1 10.0.0.2", "\u00e4"};
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
    public void onlyTheSendersOwnPrivateAddressIsUsable() {
        final String[] near = {"127.0.0.1", "10.255.0.1", "172.16.0.1", "172.31.255.1",
            "192.168.43.7", "169.254.1.2", "100.64.0.1", "100.127.0.1"};
        for (String each : near) {
            assertTrue(each, DiscoveryAnswer.isUsable(each, each));
            assertFalse(each, DiscoveryAnswer.isUsable(each, "192.168.43.9"));
        }
        final String[] far = {"203.0.113.9", "172.15.0.1", "172.32.0.1", "192.169.0.1", "11.0.0.1",
            "100.63.0.1", "100.128.0.1", "169.253.0.1", "0.0.0.0", "224.0.0.1", "255.255.255.255"};
        for (String each : far) {
            assertFalse(each, DiscoveryAnswer.isUsable(each, each));
        }
        assertFalse(DiscoveryAnswer.isUsable("010.0.0.1", "10.0.0.1"));
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
