package org.raspilot.app.commands;

import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;
import org.raspilot.up.ground.GainKey;
import org.raspilot.up.ground.GainsForm;
import org.raspilot.up.ground.GainsService.GainChange;
import org.raspilot.up.ground.GainsService;

/**
 * The edits of the gains, beside the active gains.
 *
 * <p>An edited cell remembers the active value at the time of the edit. If the active value changes
 * afterwards, the cell keeps the edit and the two are a conflict. Main thread only.
 */
final class GainsEditor {
    private static final class Edit {
        private final String written;
        private final Double seen;

        private Edit(String written, Double seen) {
            this.written = written;
            this.seen = seen;
        }
    }

    private final Map<GainKey, Edit> edits = new LinkedHashMap<>();
    private GainSet flying;

    /** Returns the active gains, or null if unknown. */
    GainSet flying() {
        return flying;
    }

    /** Takes the active gains; an edit that equals its active value is dropped. */
    void setActive(GainSet set) {
        flying = set;
        if (set == null) {
            // During a new request, edits wait for the answer.
            return;
        }
        for (GainKey key : new ArrayList<>(edits.keySet())) {
            if (isAsFlying(key, edits.get(key).written)) {
                edits.remove(key);
            }
        }
    }

    /** Edits a cell; the active value, or the empty text of a gain without one, is not an edit. */
    void write(GainKey key, String written) {
        Edit before = edits.get(key);
        if (isAsFlying(key, written)) {
            edits.remove(key);
        } else {
            edits.put(key, new Edit(written, before == null ? key.of(flying) : before.seen));
        }
    }

    /** Takes back everything that was written. */
    void discard() {
        edits.clear();
    }

    /** Marks conflicts as seen: edits are now relative to the active gains. */
    void accept() {
        for (Map.Entry<GainKey, Edit> each : edits.entrySet()) {
            each.setValue(new Edit(each.getValue().written, each.getKey().of(flying)));
        }
    }

    boolean hasEdits() {
        return !edits.isEmpty();
    }

    /** Returns whether a cell differs from its active value. */
    boolean isEdited(GainKey key) {
        return edits.containsKey(key);
    }

    String textOf(GainKey key) {
        Edit edit = edits.get(key);
        return edit == null ? text(key.of(flying)) : edit.written;
    }

    /** Returns whether the edit of a cell is not a valid gain. */
    boolean isWrong(GainKey key) {
        Edit edit = edits.get(key);
        return edit != null && !edit.written.trim().isEmpty()
                && GainsForm.number(edit.written) == null;
    }

    /** Returns the gains that fly otherwise than their writer saw; unmodifiable. */
    List<GainKey> conflicts() {
        List<GainKey> found = new ArrayList<>();
        for (Map.Entry<GainKey, Edit> each : edits.entrySet()) {
            Double now = each.getKey().of(flying);
            if (flying != null && !text(now).equals(text(each.getValue().seen))) {
                found.add(each.getKey());
            }
        }
        return Collections.unmodifiableList(found);
    }

    /** Returns the flying value that the writer of a cell saw, as text; empty: none. */
    String seenText(GainKey key) {
        Edit edit = edits.get(key);
        return edit == null ? "" : text(edit.seen);
    }

    /**
     * Returns the whole set to send. Unedited values are returned exactly as received.
     *
     * @throws InvalidCommandException with one sentence that names the gain
     */
    GainSet wanted() {
        Map<GainKey, String> typed = new LinkedHashMap<>();
        for (Map.Entry<GainKey, Edit> edit : edits.entrySet()) {
            typed.put(edit.getKey(), edit.getValue().written);
        }
        return GainsForm.read(typed, flying);
    }

    /** Returns what sending would change; empty while a cell has no valid gain. */
    List<GainChange> changes() {
        try {
            return GainsService.difference(flying, wanted());
        } catch (InvalidCommandException notYet) {
            // The sentence stands beside the form already.
            return Collections.emptyList();
        }
    }

    /** Returns a gain with at most six significant digits, or an empty text. */
    static String text(Double gain) {
        if (gain == null) {
            return "";
        }
        String text = String.format(Locale.ROOT, "%.4f", gain);
        return text.replaceFirst("0{1,3}$", "");
    }

    private boolean isAsFlying(GainKey key, String written) {
        Double now = key.of(flying);
        if (written.trim().isEmpty()) {
            return now == null;
        }
        Double value = GainsForm.number(written);
        return now != null && value != null && text(value).equals(text(now));
    }
}
