package org.raspilot.app.ground;

import android.os.Bundle;
import android.view.View;
import android.widget.RadioGroup;
import org.raspilot.app.R;

/**
 * Shows one of track, state and values if only one fits; a layout with room for all has no buttons,
 * and everything stays visible.
 */
final class PanelSwitch {
    private static final String CHOSEN = "ground.panel";
    private static final int[] BUTTONS = {
        R.id.ground_show_track, R.id.ground_show_state, R.id.ground_show_values
    };
    private static final int[] BOXES = {
        R.id.ground_track_box, R.id.ground_state_box, R.id.ground_values_box
    };

    private final View root;
    private final RadioGroup buttons;

    /** Finds its views; {@code chosen} is which panel is to be seen, 0 to 2. */
    PanelSwitch(View root, int chosen) {
        this.root = root;
        buttons = (RadioGroup) root.findViewById(R.id.ground_panels);
        if (buttons != null) {
            buttons.setOnCheckedChangeListener((group, button) -> show(chosen(0)));
            buttons.check(BUTTONS[chosen]);
            show(chosen);
        }
    }

    /** Returns the visible panel; {@code otherwise} if all are. */
    int chosen(int otherwise) {
        if (buttons == null) {
            return otherwise;
        }
        for (int each = 0; each < BUTTONS.length; each++) {
            if (BUTTONS[each] == buttons.getCheckedRadioButtonId()) {
                return each;
            }
        }
        return 0;
    }

    /** Returns what a screen kept, 0 to 2. */
    static int kept(Bundle state) {
        int kept = state == null ? 0 : state.getInt(CHOSEN, 0);
        return kept < 0 || kept >= BUTTONS.length ? 0 : kept;
    }

    static void keep(Bundle state, int chosen) {
        state.putInt(CHOSEN, chosen);
    }

    private void show(int chosen) {
        for (int each = 0; each < BOXES.length; each++) {
            View box = root.findViewById(BOXES[each]);
            box.setVisibility(each == chosen ? View.VISIBLE : View.GONE);
        }
    }
}
