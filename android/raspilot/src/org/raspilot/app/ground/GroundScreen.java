package org.raspilot.app.ground;

import android.app.Activity;
import android.view.View;
import org.raspilot.app.R;
import org.raspilot.app.view.FrameText;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.android.TelemetryService;

/** The parts of the ground screen while its views live. */
final class GroundScreen {
    private final FrameLine frame;
    private final AlarmPanel alarms;
    private final ControlPanel seat;
    private final InstrumentPanel instruments;
    private final TrackPanel track;
    private final FlightActions actions;
    private final StatePanel state;
    private final EventPanel events;
    private final ValuesPanel values;
    private final PanelSwitch panels;

    /** Finds all views; {@code panel} is the visible one if only one fits. */
    GroundScreen(Activity activity, View root, int panel, GroundSpeed speed, AlarmPanel alarms) {
        this.alarms = alarms;
        frame = new FrameLine((FrameText) root.findViewById(R.id.ground_frame));
        seat = new ControlPanel(root);
        instruments = new InstrumentPanel(root, speed);
        track = new TrackPanel(activity, root);
        actions = new FlightActions(activity, root, frame);
        state = new StatePanel(root);
        events = new EventPanel(root);
        values = new ValuesPanel(root);
        panels = new PanelSwitch(root, panel);
    }

    /** Sets the ground; null: none. */
    void setGround(TelemetryService.Ground ground) {
        frame.clear();
        seat.setGround(ground);
        actions.setGround(ground);
    }

    /** Returns the visible panel; {@code otherwise} if all are. */
    int panel(int otherwise) {
        return panels.chosen(otherwise);
    }

    void showNewest(GroundSnapshot picture) {
        frame.update(picture);
        instruments.update(picture);
        track.update(picture);
    }

    void showAll(GroundSnapshot picture) {
        showNewest(picture);
        alarms.update(picture);
        seat.update(picture);
        actions.update(picture);
        state.update(picture);
        events.update(picture);
        values.update(picture);
    }

    void close() {
        seat.setGround(null);
        actions.setGround(null);
        frame.close();
    }
}
