package org.raspilot.app;

import java.util.regex.Pattern;
import org.raspilot.up.providers.AltitudeProvider;

/** The rule for a setting, and the sentence that states it. */
enum SettingRule {
    /** A host's name or address. */
    HOST(R.string.rule_host) {
        @Override
        boolean holds(String value) {
            return value.length() <= 253 && HOSTS.matcher(value).matches();
        }
    },
    /** The same, or nothing. */
    HOST_OR_NOTHING(R.string.rule_host) {
        @Override
        boolean holds(String value) {
            return value.isEmpty() || HOST.holds(value);
        }
    },
    /** A port, 1 to 65535. */
    PORT(R.string.rule_port) {
        @Override
        boolean holds(String value) {
            return isWhole(value, 1, 65535);
        }
    },
    /** An aircraft's name. */
    AIRCRAFT(R.string.rule_aircraft) {
        @Override
        boolean holds(String value) {
            return AIRCRAFTS.matcher(value).matches();
        }
    },
    /** A profile's name, or nothing. */
    PROFILE(R.string.rule_profile) {
        @Override
        boolean holds(String value) {
            return value.isEmpty() || AIRCRAFTS.matcher(value).matches();
        }
    },
    /** How often orientation leaves, Hz. */
    RATE(R.string.rule_rate) {
        @Override
        boolean holds(String value) {
            return isWhole(value, 50, 200);
        }
    },
    /** The pressure at altitude zero, hPa. */
    PRESSURE(R.string.rule_pressure) {
        @Override
        boolean holds(String value) {
            return NUMBERS.matcher(value).matches() && isWithin(number(value));
        }
    };

    private static final Pattern HOSTS = Pattern.compile("[A-Za-z0-9_.:%-]+");
    private static final Pattern AIRCRAFTS = Pattern.compile("[A-Za-z0-9_-][A-Za-z0-9_.-]{0,31}");
    private static final Pattern WHOLES = Pattern.compile("[0-9]{1,9}");
    private static final Pattern NUMBERS = Pattern.compile("[0-9]{1,5}([.,][0-9]{1,6})?");

    private final int sentence;

    SettingRule(int sentence) {
        this.sentence = sentence;
    }

    /** Returns whether a value, trimmed, is valid. */
    abstract boolean holds(String value);

    /** Returns the resource of the sentence that states the rule. */
    int sentence() {
        return sentence;
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

    private static boolean isWithin(double hPa) {
        return hPa >= AltitudeProvider.MIN_REFERENCE_HPA
                && hPa <= AltitudeProvider.MAX_REFERENCE_HPA;
    }
}
