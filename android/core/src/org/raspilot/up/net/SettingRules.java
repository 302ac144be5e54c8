package org.raspilot.up.net;

import java.util.regex.Pattern;
import org.raspilot.up.security.Pairing;
import org.raspilot.up.wire.Hello;

/** The rules that settings share; each throws IllegalArgumentException with a sentence. */
public final class SettingRules {
    private static final int MAX_HOST_LENGTH = 253;
    private static final Pattern HOST = Pattern.compile("[A-Za-z0-9_.:%-]+");

    private SettingRules() {
    }

    public static boolean isHost(String text) {
        return text.length() <= MAX_HOST_LENGTH && HOST.matcher(text).matches();
    }

    public static void host(String setting, String host) {
        if (!isHost(host)) {
            throw new IllegalArgumentException("the " + setting
                    + " must be a name or an address, without blanks and slashes");
        }
    }

    public static void port(String setting, int port) {
        range(setting, port, 1, 65535);
    }

    /** Checks the name of an aircraft, as proxies and runners know it. */
    public static void aircraft(String name) {
        if (!Hello.isAircraftName(name)) {
            throw new IllegalArgumentException("the aircraft's name must be 1 to 32 of"
                    + " A-Z a-z 0-9 _ . - and not begin with a dot");
        }
    }

    /** Checks that a key, if there is one, is that of the aircraft. */
    public static void pairing(Pairing key, String aircraft) {
        if (key != null && !key.aircraft.equals(aircraft)) {
            throw new IllegalArgumentException("the key is that of another aircraft");
        }
    }

    public static void range(String setting, int value, int least, int most) {
        if (value < least || value > most) {
            throw new IllegalArgumentException("the " + setting
                    + " must be " + least + " to " + most + ", not " + value);
        }
    }

    /** Checks a number; NaN is refused. */
    public static void range(String setting, double value, double least, double most) {
        if (!(value >= least && value <= most)) {
            throw new IllegalArgumentException("the " + setting
                    + " must be " + (long) least + " to " + (long) most + ", not " + value);
        }
    }
}
