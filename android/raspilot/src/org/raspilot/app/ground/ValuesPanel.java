package org.raspilot.app.ground;

import org.raspilot.app.view.TextListener;
import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import android.widget.BaseAdapter;
import android.widget.EditText;
import android.widget.ListView;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import org.raspilot.app.R;
import org.raspilot.app.commands.CommandGroup;
import org.raspilot.app.view.InstrumentColors;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.ground.Telemetry;
import org.raspilot.up.ground.TelemetryText.TelemetryRow;
import org.raspilot.up.ground.TelemetryText;

/** Every value of the newest frame, including those of unknown modules. */
final class ValuesPanel extends BaseAdapter {
    private final View element;
    private final EditText filter;
    private final ListView list;
    private final LayoutInflater inflater;
    private final InstrumentColors colors;
    private List<TelemetryRow> all = Collections.emptyList();
    private List<TelemetryRow> rows = Collections.emptyList();
    private Telemetry shown;
    private GroundSnapshot picture = GroundSnapshot.of(null);

    ValuesPanel(View root) {
        inflater = LayoutInflater.from(root.getContext());
        colors = InstrumentColors.of(root.getContext());
        element = root.findViewById(R.id.ground_values_box);
        filter = (EditText) root.findViewById(R.id.ground_filter);
        filter.addTextChangedListener((TextListener) text -> choose());
        list = (ListView) root.findViewById(R.id.ground_values);
        list.setAdapter(this);
    }

    /** Shows the current state, while it is visible. */
    void update(GroundSnapshot now) {
        if (!element.isShown()) {
            return;
        }
        picture = now;
        if (shown != now.telemetry) {
            shown = now.telemetry;
            all = TelemetryText.rows(now.telemetry);
            List<TelemetryRow> newest = chosen(all, filter.getText().toString());
            boolean isSameList = newest.size() == rows.size();
            rows = newest;
            if (!isSameList) {
                notifyDataSetChanged();
                return;
            }
        }
        // Unmoved rows are updated in place: nothing moves under a finger.
        for (int child = 0; child < list.getChildCount(); child++) {
            int position = list.getFirstVisiblePosition() + child;
            if (position < rows.size()) {
                getView(position, list.getChildAt(child), list);
            }
        }
    }

    /** Returns the rows whose path contains each of the words, ignoring case. */
    private static List<TelemetryRow> chosen(List<TelemetryRow> all, String words) {
        List<TelemetryRow> found = new ArrayList<>();
        for (TelemetryRow row : all) {
            if (CommandGroup.matches(words, row.path)) {
                found.add(row);
            }
        }
        return found;
    }

    @Override
    public int getCount() {
        return rows.size();
    }

    @Override
    public Object getItem(int position) {
        return rows.get(position);
    }

    @Override
    public long getItemId(int position) {
        return position;
    }

    @Override
    public boolean areAllItemsEnabled() {
        return false;
    }

    @Override
    public boolean isEnabled(int position) {
        return false;
    }

    @Override
    public View getView(int position, View used, ViewGroup list) {
        View element = used;
        if (element == null) {
            element = inflater.inflate(R.layout.row_ground, list, false);
            element.setTag(new Row(element, colors));
        }
        TelemetryRow row = rows.get(position);
        Row view = (Row) element.getTag();
        view.label(row.path);
        String value = row.unit.isEmpty() ? row.value : row.value + " " + row.unit;
        view.show(value, picture.telemetry.freshness(row.path, picture.nowMs),
                InstrumentPanel.ageText(picture, row.path), Row.Look.PLAIN);
        return element;
    }

    private void choose() {
        rows = chosen(all, filter.getText().toString());
        notifyDataSetChanged();
    }
}
