package org.raspilot.up.ground;

import java.util.HashMap;
import java.util.Map;
import java.util.regex.Pattern;
import org.raspilot.up.commands.GainSet.Gains;
import org.raspilot.up.commands.GainSet.LoopGains;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;
import org.raspilot.up.ground.GainsService.GainChange;
import org.raspilot.up.wire.SafeText;

/** Reads the gains that a person has typed, and judges sets before they are sent. */
public final class GainsForm {
    private static final Pattern NUMBER = Pattern.compile("[0-9]{1,6}([.,][0-9]{0,12})?");
    private static final int MAX_SHOWN_LENGTH = 20;

    private GainsForm() {
    }

    /**
     * Returns the set of the form.
     *
     * <p>Rate and stabilize must be complete for ailerons and elevator; the rudder is in both or in
     * neither; navigation is complete or empty, its rudder may be empty.
     *
     * @param cells the typed texts by {@link GainKey#path}; an empty one counts as absent
     * @throws InvalidCommandException with one sentence that names the gain
     */
    public static GainSet read(Map<String, String> cells) {
        final Map<GainKey, Double> values = new HashMap<>();
        for (GainKey key : GainKey.ALL) {
            final String typed = cells.get(key.path());
            if (typed != null && !typed.trim().isEmpty()) {
                values.put(key, number(key, typed.trim()));
            }
        }
        final GainSet set = new GainSet(loop(0, values, true), loop(1, values, true),
                loop(2, values, false));
        final String fault = fault(set);
        if (fault != null) {
            throw new InvalidCommandException(fault);
        }
        return set;
    }

    /** Returns the initial texts of a form; a gain that the set lacks is empty. */
    public static Map<String, String> cells(GainSet set) {
        final Map<String, String> cells = new HashMap<>();
        for (GainKey key : GainKey.ALL) {
            final Double value = key.of(set);
            cells.put(key.path(), value == null ? "" : GainChange.number(value));
        }
        return cells;
    }

    /** Returns a sentence why a set may not be sent, or null. */
    public static String fault(GainSet set) {
        if (set.rate == null || set.stabilize == null) {
            return "the set is not whole: the " + (set.rate == null ? "rate" : "stabilize")
                    + " loop is missing";
        }
        if ((set.rate.rudder == null) != (set.stabilize.rudder == null)) {
            return "the set is not whole: yaw must be in the rate and in the stabilize loop, or in"
                    + " neither";
        }
        for (GainKey key : GainKey.ALL) {
            final Double value = key.of(set);
            if (value == null) {
                // A set without navigation leaves the navigation gains unchanged.
                if (!key.isRudder() && key.isIn(set)) {
                    return "the set is not whole: " + key.words() + " is missing";
                }
            } else if (!(value >= 0 && value <= Gains.MAX)) {
                // Written so that NaN is refused, too.
                return key.words() + " must be 0 to 50, not " + GainChange.number(value);
            }
        }
        return null;
    }

    /** Parses a typed gain, with a point or a comma; null if it is not a gain. */
    public static Double number(String typed) {
        final String trimmed = typed.trim();
        if (!NUMBER.matcher(trimmed).matches()) {
            return null;
        }
        final double value = Double.parseDouble(trimmed.replace(',', '.'));
        return value <= Gains.MAX ? Double.valueOf(value) : null;
    }

    private static double number(GainKey key, String typed) {
        final Double value = number(typed);
        if (value == null) {
            throw new InvalidCommandException(key.words() + " must be a number, 0 to 50, not "
                    + SafeText.of(typed, MAX_SHOWN_LENGTH));
        }
        return value;
    }

    private static LoopGains loop(int loop, Map<GainKey, Double> values, boolean isNeeded) {
        final int first = loop * GainKey.IN_LOOP;
        boolean isEmpty = true;
        for (GainKey key : GainKey.ALL.subList(first, first + GainKey.IN_LOOP)) {
            isEmpty &= !values.containsKey(key);
        }
        if (isEmpty && !isNeeded) {
            return null;
        }
        return new LoopGains(gains(first, values, true), gains(first + 3, values, true),
                gains(first + 6, values, false));
    }

    private static Gains gains(int first, Map<GainKey, Double> values, boolean isNeeded) {
        GainKey missing = null;
        int count = 0;
        for (GainKey key : GainKey.ALL.subList(first, first + 3)) {
            if (values.containsKey(key)) {
                count++;
            } else {
                missing = missing == null ? key : missing;
            }
        }
        if (count == 0 && !isNeeded) {
            return null;
        }
        if (missing != null) {
            throw new InvalidCommandException(
                    "the set is not whole: " + missing.words() + " is missing");
        }
        return new Gains(values.get(GainKey.ALL.get(first)),
                values.get(GainKey.ALL.get(first + 1)), values.get(GainKey.ALL.get(first + 2)));
    }
}
