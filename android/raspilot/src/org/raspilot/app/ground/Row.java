package org.raspilot.app.ground;

import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import android.widget.TextView;
import org.raspilot.app.R;
import org.raspilot.app.view.Hatch;
import org.raspilot.app.view.Instrument;
import org.raspilot.app.view.InstrumentColors;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.ground.Freshness;

/** A label and a value that is greyed out when stale. */
final class Row {
    /** The colour of a current value. */
    enum Look {
        PLAIN,
        GOOD,
        WARNING,
        ALARM
    }

    private final View element;
    private final TextView label;
    private final TextView value;
    private final InstrumentColors colors;
    private final Hatch hatch;
    private Boolean wasStale;

    /** Takes an element that was inflated from row_ground. */
    Row(View element, InstrumentColors colors) {
        this.element = element;
        this.colors = colors;
        hatch = new Hatch(element.getContext(), colors.hatch);
        label = (TextView) element.findViewById(R.id.row_label);
        value = (TextView) element.findViewById(R.id.row_value);
    }

    /** Creates a row at the end of a list of rows. */
    static Row in(ViewGroup list, int labelText, InstrumentColors colors) {
        LayoutInflater inflater = LayoutInflater.from(list.getContext());
        View element = inflater.inflate(R.layout.row_ground, list, false);
        list.addView(element);
        Row row = new Row(element, colors);
        row.label.setText(labelText);
        return row;
    }

    void label(String text) {
        TextViews.show(label, text);
    }

    /** Shows a value; a stale one is grey and hatched, with its age in words. */
    void show(String text, Freshness freshness, String age, Look look) {
        boolean isStale = freshness == Freshness.STALE;
        String shown = freshness == Freshness.NONE ? Instrument.UNKNOWN : text;
        if (isStale) {
            shown = element.getResources().getString(R.string.ground_old, text, age);
        }
        TextViews.show(value, shown);
        TextViews.colour(value, freshness == Freshness.LIVE ? colourOf(look) : colors.dim);
        if (wasStale == null || wasStale != isStale) {
            wasStale = isStale;
            hatch.setActive(isStale);
            setBackground();
        }
    }

    void setVisible(boolean isVisible) {
        element.setVisibility(isVisible ? View.VISIBLE : View.GONE);
    }

    private void setBackground() {
        if (value.getBackground() != hatch) {
            value.setBackground(hatch);
        }
    }

    private int colourOf(Look look) {
        switch (look) {
            case GOOD:
                return colors.good;
            case WARNING:
                return colors.warning;
            case ALARM:
                return colors.alarm;
            default:
                return colors.ink;
        }
    }
}
