package org.raspilot.app.commands;

import org.raspilot.app.view.TextListener;
import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import android.widget.EditText;
import android.widget.TextView;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import org.raspilot.app.R;
import org.raspilot.app.view.InstrumentColors;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.ground.GainKey;

/** The cells of the gains that are used: a heading a loop, a row an axis, P, I and D in it. */
final class GainsTable {
    private static final int[] LOOPS = {
        R.string.gains_rate, R.string.gains_stabilize
    };
    private static final int[] AXES = {
        R.string.gains_roll, R.string.gains_pitch, R.string.gains_yaw
    };
    private static final int[] CELLS = {R.id.gain_p, R.id.gain_i, R.id.gain_d};
    private static final int[] FLYING = {R.id.flying_p, R.id.flying_i, R.id.flying_d};

    private final GainsEditor editor;
    private final Runnable onWritten;
    private final InstrumentColors colors;
    private final List<Cell> cells = new ArrayList<>();
    private boolean isFilling;

    GainsTable(View page, GainsEditor editor, Runnable onWritten) {
        this.editor = editor;
        this.onWritten = onWritten;
        colors = InstrumentColors.of(page.getContext());
        ViewGroup list = (ViewGroup) page.findViewById(R.id.gains_table);
        LayoutInflater inflater = LayoutInflater.from(page.getContext());
        for (int loop = 0; loop < LOOPS.length; loop++) {
            View heading = inflater.inflate(R.layout.heading_gains, list, false);
            ((TextView) heading.findViewById(R.id.gains_loop)).setText(LOOPS[loop]);
            list.addView(heading);
            for (int axis = 0; axis < AXES.length; axis++) {
                if (GainKey.ALL.get(9 * loop + 3 * axis).isUsed()) {
                    addRow(inflater, list, loop, axis);
                }
            }
        }
        refill();
    }

    /** Copies the editor's texts into every cell. */
    void refill() {
        isFilling = true;
        try {
            for (Cell cell : cells) {
                String text = editor.textOf(cell.key);
                if (!text.contentEquals(cell.input.getText())) {
                    cell.input.setText(text);
                }
            }
        } finally {
            isFilling = false;
        }
    }

    /** Shows which cells differ from the active gains, and whether editing is possible. */
    void update(boolean isOffered) {
        for (Cell cell : cells) {
            if (cell.input.isEnabled() != isOffered) {
                cell.input.setEnabled(isOffered);
            }
            boolean isEdited = editor.isEdited(cell.key);
            Double now = cell.key.of(editor.flying());
            String flies = now == null ? "" : cell.input.getResources()
                    .getString(R.string.gains_flies, GainsEditor.text(now));
            TextViews.showOrHide(cell.flying, isEdited ? flies : "");
            TextViews.colour(cell.input, editor.isWrong(cell.key) ? colors.alarm
                    : isEdited ? colors.accent : colors.ink);
        }
    }

    private void addRow(LayoutInflater inflater, ViewGroup list, int loop, int axis) {
        View row = inflater.inflate(R.layout.row_gains, list, false);
        ((TextView) row.findViewById(R.id.gain_axis)).setText(AXES[axis]);
        for (int term = 0; term < CELLS.length; term++) {
            GainKey key = GainKey.ALL.get(9 * loop + 3 * axis + term);
            EditText input = (EditText) row.findViewById(CELLS[term]);
            input.setContentDescription(key.words());
            input.setHint(key.term().toUpperCase(Locale.ROOT));
            // Each row has the same ids, so only the editor stores the texts.
            input.setSaveEnabled(false);
            Cell cell = new Cell(key, input, (TextView) row.findViewById(FLYING[term]));
            input.addTextChangedListener((TextListener) text -> write(key, text.toString()));
            cells.add(cell);
        }
        list.addView(row);
    }

    private void write(GainKey key, String text) {
        if (!isFilling) {
            editor.write(key, text);
            onWritten.run();
        }
    }

    private static final class Cell {
        private final GainKey key;
        private final EditText input;
        private final TextView flying;

        private Cell(GainKey key, EditText input, TextView flying) {
            this.key = key;
            this.input = input;
            this.flying = flying;
        }
    }
}
