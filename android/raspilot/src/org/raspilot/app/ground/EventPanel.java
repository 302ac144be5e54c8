package org.raspilot.app.ground;

import android.view.View;
import android.widget.TextView;
import java.util.List;
import org.raspilot.app.R;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.ground.Age;
import org.raspilot.up.ground.Event;

/** The newest events, the newest first, each with how long ago it was. */
final class EventPanel {
    private static final int MAX_EVENTS = 12;

    private final TextView view;

    EventPanel(View root) {
        view = (TextView) root.findViewById(R.id.ground_events);
    }

    void update(GroundSnapshot picture) {
        if (!view.isShown()) {
            return;
        }
        StringBuilder all = new StringBuilder();
        if (picture.events != null) {
            List<Event> events = picture.events.events;
            int oldest = Math.max(0, events.size() - MAX_EVENTS);
            for (int each = events.size() - 1; each >= oldest; each--) {
                Event event = events.get(each);
                all.append(all.length() == 0 ? "" : "\n");
                all.append(view.getResources().getString(R.string.ground_event,
                        ControlPanel.sentence(event.text), Age.agoText(picture.nowMs - event.atMs)));
            }
        }
        String text = all.length() == 0
                ? view.getResources().getString(R.string.ground_no_events) : all.toString();
        TextViews.show(view, text);
    }
}
