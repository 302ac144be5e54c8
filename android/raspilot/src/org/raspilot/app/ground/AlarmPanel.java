package org.raspilot.app.ground;

import android.view.View;
import android.widget.Button;
import android.widget.TextView;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.app.R;
import org.raspilot.app.view.InstrumentColors;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.ground.Alarm;
import org.raspilot.up.ground.EventLevel;

/** The active alarms in words, and the button that silences them. Hidden without alarms. */
final class AlarmPanel {
    private final View element;
    private final TextView text;
    private final Button silence;
    private final InstrumentColors colors;
    private final AlarmBell bell;
    private final Sounder sounder;

    /** Finds its views; the caller owns the bell. */
    AlarmPanel(View root, AlarmBell bell, Sounder sounder) {
        this.bell = bell;
        this.sounder = sounder;
        colors = InstrumentColors.of(root.getContext());
        element = root.findViewById(R.id.ground_alarms);
        text = (TextView) root.findViewById(R.id.ground_alarm_text);
        silence = (Button) root.findViewById(R.id.ground_silence);
        silence.setOnClickListener(pressed -> silence());
    }

    /** Shows the current state, and sounds the due alarms. */
    void update(GroundSnapshot picture) {
        List<Alarm> active = picture.alarms == null
                ? java.util.Collections.emptyList() : picture.alarms.active;
        if (picture.alarms != null) {
            // While the alarms are unknown, silenced ones stay silenced.
            bell.update(loud(active));
            sounder.ring(bell.ringAt(picture.nowMs));
        }
        element.setVisibility(active.isEmpty() ? View.GONE : View.VISIBLE);
        String words = words(active);
        // A live region: a screen reader speaks its changes.
        TextViews.show(text, words);
        TextViews.colour(text, hasAlarm(active) ? colors.alarm : colors.warning);
        silence.setVisibility(bell.isRinging() ? View.VISIBLE : View.GONE);
    }

    private void silence() {
        bell.silence();
        sounder.stop();
        silence.setVisibility(View.GONE);
    }

    private static Map<String, EventLevel> loud(List<Alarm> active) {
        Map<String, EventLevel> loud = new HashMap<>();
        for (Alarm each : active) {
            if (each.isLoud()) {
                loud.put(each.kind, each.level);
            }
        }
        return loud;
    }

    private static boolean hasAlarm(List<Alarm> active) {
        for (Alarm each : active) {
            if (each.level == EventLevel.ALARM) {
                return true;
            }
        }
        return false;
    }

    private static String words(List<Alarm> active) {
        StringBuilder all = new StringBuilder();
        for (Alarm each : active) {
            all.append(all.length() == 0 ? "" : " ").append(ControlPanel.sentence(each.text));
        }
        return all.toString();
    }
}
