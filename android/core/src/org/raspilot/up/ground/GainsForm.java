package org.raspilot.up.ground;

import java.util.LinkedHashMap;
import java.util.Map;
import java.util.regex.Pattern;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.GainSet.Gains;
import org.raspilot.up.commands.InvalidCommandException;
import org.raspilot.up.wire.SafeText;

/** Reads the gains that a person has typed. */
public final class GainsForm {
    private static final Pattern NUMBER = Pattern.compile("[0-9]{1,6}([.,][0-9]{0,12})?");
    private static final int MAX_SHOWN_LENGTH = 20;

    private GainsForm() {
    }

    /**
     * Returns the active set with a person's edits; unedited values stay exactly as they are.
     *
     * <p>Rate and stabilize must be complete for ailerons and elevator; the rudder is in both or in
     * neither.
     *
     * @param edits the typed texts; an empty one takes the gain out
     * @param active null: none
     * @throws InvalidCommandException with one sentence that names the gain
     */
    public static GainSet read(Map<GainKey, String> edits, GainSet active) {
        final Map<String, Object> set = new LinkedHashMap<>();
        for (GainKey key : GainKey.ALL) {
            final String typed = edits.get(key);
            final Double value = typed == null ? key.of(active)
                    : typed.trim().isEmpty() ? null : number(key, typed);
            if (value != null) {
                inside(inside(set, key.loop()), key.axis()).put(key.term(), value);
            }
        }
        try {
            return GainSet.ofData(set);
        } catch (InvalidCommandException fault) {
            throw fault.naming(words(fault.field));
        }
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

    private static Double number(GainKey key, String typed) {
        final Double value = number(typed);
        if (value == null) {
            throw new InvalidCommandException("out_of_range", key.path(),
                    "must be a number, 0 to 50, not " + SafeText.of(typed, MAX_SHOWN_LENGTH))
                    .naming(key.words());
        }
        return value;
    }

    @SuppressWarnings("unchecked")
    private static Map<String, Object> inside(Map<String, Object> outer, String key) {
        if (!outer.containsKey(key)) {
            outer.put(key, new LinkedHashMap<String, Object>());
        }
        return (Map<String, Object>) outer.get(key);
    }

    /** Returns a place in the words of the table. */
    private static String words(String place) {
        for (GainKey key : GainKey.ALL) {
            if (key.path().equals(place)) {
                return key.words();
            }
        }
        return place;
    }
}
