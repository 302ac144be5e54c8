package org.raspilot.up.android;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import org.junit.Test;
import org.raspilot.up.android.api23.Subnet;

public final class WifiBindingTest {
    private static final String CABLE = "192.168.42.17";
    private static final String WIFI = "192.168.4.1";

    private final PhoneWifi wifi = new PhoneWifi();
    private long nowMs = 1000;

    @Test
    public void unwantedItIsNeverBound() {
        WifiBinding way = new WifiBinding(wifi, false, WIFI);
        pass(way, 60000, null);
        look(way, WIFI);
        assertEquals("", wifi.said());
    }

    @Test
    public void aLinkByCableIsNeverBound() {
        WifiBinding way = new WifiBinding(wifi, true, "");
        look(way, CABLE);
        way.networksChanged();
        pass(way, 60000, CABLE);
        assertFalse(wifi.isBound);
    }

    @Test
    public void aWifiThatIsJoinedInFlightChangesNothingForTheCable() {
        wifi.isThere = false;
        WifiBinding way = new WifiBinding(wifi, true, CABLE);
        look(way, CABLE);
        wifi.isThere = true;
        way.networksChanged();
        look(way, CABLE);
        assertFalse(wifi.isBound);
        // The cable is unplugged: its attempts are the unbound ones, until there is a link.
        pass(way, 60000, null);
        assertFalse(wifi.isBound);
    }

    @Test
    public void anAddressOfTheWifisNetworkIsBoundAtOnce() {
        WifiBinding way = new WifiBinding(wifi, true, WIFI);
        assertTrue(look(way, null));
        assertTrue(wifi.isBound);
    }

    @Test
    public void itIsBoundWhenTheWifiComes() {
        wifi.isThere = false;
        WifiBinding way = new WifiBinding(wifi, true, WIFI);
        assertFalse(look(way, null));
        wifi.isThere = true;
        way.networksChanged();
        assertTrue(look(way, null));
        assertTrue(wifi.isBound);
    }

    @Test
    public void itIsReleasedWhenTheWifiGoes() {
        WifiBinding way = new WifiBinding(wifi, true, "");
        look(way, WIFI);
        assertTrue(wifi.isBound);
        wifi.isThere = false;
        way.networksChanged();
        look(way, WIFI);
        assertFalse(wifi.isBound);
    }

    @Test
    public void whatIsLookedForIsLookedForUnboundAndBoundInTurns() {
        WifiBinding way = new WifiBinding(wifi, true, "");
        pass(way, WifiBinding.TURN_MS - 500, null);
        assertFalse(wifi.isBound);
        pass(way, 500, null);
        assertTrue(wifi.isBound);
        pass(way, WifiBinding.TURN_MS, null);
        assertFalse(wifi.isBound);
        pass(way, WifiBinding.TURN_MS, null);
        assertTrue(wifi.isBound);
    }

    @Test
    public void aNewTurnAsksForAnAttempt() {
        WifiBinding way = new WifiBinding(wifi, true, "raspberrypi.local");
        assertFalse(look(way, null));
        nowMs += WifiBinding.TURN_MS;
        assertTrue(look(way, null));
        assertFalse(look(way, null));
    }

    @Test
    public void foundByTheCableAWifiIsReleased() {
        WifiBinding way = new WifiBinding(wifi, true, "");
        pass(way, WifiBinding.TURN_MS, null);
        assertTrue(wifi.isBound);
        look(way, CABLE);
        assertFalse(wifi.isBound);
        pass(way, WifiBinding.TURN_MS - 500, null);
        assertFalse(wifi.isBound);
    }

    @Test
    public void aLostWifiIsAskedFirst() {
        WifiBinding way = new WifiBinding(wifi, true, "");
        pass(way, WifiBinding.TURN_MS, null);
        pass(way, 20000, WIFI);
        assertTrue(wifi.isBound);
        pass(way, WifiBinding.TURN_MS - 500, null);
        assertTrue(wifi.isBound);
        pass(way, 1000, null);
        assertFalse(wifi.isBound);
    }

    @Test
    public void theEndReleasesIt() {
        WifiBinding way = new WifiBinding(wifi, true, WIFI);
        look(way, null);
        way.end();
        assertFalse(wifi.isBound);
    }

    @Test
    public void theSystemIsAskedWhenSomethingChangedOnly() {
        WifiBinding way = new WifiBinding(wifi, true, CABLE);
        pass(way, 60000, null);
        pass(way, 60000, CABLE);
        assertEquals("bind bind ", wifi.said());
    }

    @Test
    public void aNetworkIsItsFirstBits() {
        byte[] own = {(byte) 192, (byte) 168, 4, 2};
        assertTrue(Subnet.holds(own, 24, new byte[] {(byte) 192, (byte) 168, 4, (byte) 200}));
        assertFalse(Subnet.holds(own, 24, new byte[] {(byte) 192, (byte) 168, 5, 2}));
        assertTrue(Subnet.holds(own, 23, new byte[] {(byte) 192, (byte) 168, 5, 2}));
        assertFalse(Subnet.holds(own, 31, new byte[] {(byte) 192, (byte) 168, 4, 1}));
        assertTrue(Subnet.holds(own, 32, own));
        assertFalse(Subnet.holds(own, 0, own));
        assertFalse(Subnet.holds(own, 33, own));
        assertFalse(Subnet.holds(own, 24, new byte[16]));
    }

    private boolean look(WifiBinding way, String place) {
        return way.check(nowMs, place);
    }

    private void pass(WifiBinding way, long ms, String place) {
        look(way, place);
        for (long passed = 0; passed < ms; passed += 500) {
            nowMs += 500;
            look(way, place);
        }
    }

    /** A phone with one Wi-Fi, of the network of {@link #WIFI}. */
    private static final class PhoneWifi implements WifiBinding.Wifi {
        private final StringBuilder said = new StringBuilder();
        private boolean isThere = true;
        private boolean isBound;

        @Override
        public boolean bind(String address) {
            said.append("bind ");
            if (!isThere || !(address == null || address.startsWith("192.168.4."))) {
                return false;
            }
            isBound = true;
            return true;
        }

        @Override
        public void release() {
            said.append("release ");
            isBound = false;
        }

        String said() {
            return said.toString();
        }
    }
}
