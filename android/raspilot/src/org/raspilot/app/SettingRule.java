package org.raspilot.app;

import java.util.regex.Pattern;
import org.raspilot.up.net.SettingRules;
import org.raspilot.up.providers.AltitudeProvider;
import org.raspilot.up.providers.OrientationProvider;
import org.raspilot.up.wire.Hello;

/** The rule for a setting, and the sentence that states it. */
enum SettingRule {
    HOST_OR_NOTHING(R.string.rule_host, value -> value.isEmpty() || SettingRules.isHost(value)),
    PORT(R.string.rule_port, value -> isWhole(value, 1, 65535)),
    AIRCRAFT(R.string.rule_aircraft, value -> Hello.isAircraftName(value)),
    PROFILE(R.string.rule_profile, value -> value.isEmpty() || Hello.isAircraftName(value)),
    /** How often orientation leaves, Hz. */
    RATE(R.string.rule_rate, value -> isWhole(value, OrientationProvider.MIN_HZ,
            OrientationProvider.MAX_HZ)),
    /** The pressure at altitude zero, hPa. */
    PRESSURE(R.string.rule_pressure, value ->
            isNumber(value) && AltitudeProvider.isReference(number(value)));

    private interface Check {
        boolean holds(String value);
    }

    private static final Pattern WHOLES = Pattern.compile("[0-9]{1,9}");
    private static final Pattern NUMBERS = Pattern.compile("[0-9]{1,5}([.,][0-9]{1,6})?");

    final int sentence;
    private final Check check;

    SettingRule(int sentence, Check check) {
        this.sentence = sentence;
        this.check = check;
    }

    /** Returns whether a value, trimmed, is valid. */
    boolean holds(String value) {
        return check.holds(value);
    }

    /** Parses the number of a value; some phones' keyboards have only a comma. */
    static double number(String value) {
        return Double.parseDouble(value.replace(',', '.'));
    }

    private static boolean isWhole(String value, int least, int greatest) {
        if (!WHOLES.matcher(value).matches()) {
            return false;
        }
        int number = Integer.parseInt(value);
        return number >= least && number <= greatest;
    }

    private static boolean isNumber(String value) {
        return NUMBERS.matcher(value).matches();
    }
}
