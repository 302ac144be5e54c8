package org.raspilot.app.ground;

import android.os.Bundle;
import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import org.raspilot.app.R;
import org.raspilot.app.WatchingFragment;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.up.android.TelemetryService;

/**
 * The ground screen: instruments, track, state and every value of the telemetry (thesis 4.5.3).
 *
 * <p>Main thread only.
 */
public final class GroundFragment extends WatchingFragment {
    private static final String SILENCED = "ground.silenced";

    private final AlarmBell bell = new AlarmBell();
    private final GroundSpeed speed = new GroundSpeed();

    private Sounder sounder;
    private int panel;
    private GroundScreen screen;

    @Override
    public void onCreate(Bundle saved) {
        super.onCreate(saved);
        panel = PanelSwitch.kept(saved);
        String[] silenced = saved == null ? null : saved.getStringArray(SILENCED);
        if (silenced != null) {
            bell.restore(silenced);
        }
        sounder = new Sounder(getActivity());
    }

    @Override
    public View onCreateView(LayoutInflater inflater, ViewGroup container, Bundle saved) {
        View root = inflater.inflate(R.layout.fragment_ground, container, false);
        // Only while it is visible: the window resets it with the view.
        root.setKeepScreenOn(true);
        screen = new GroundScreen(getActivity(), root, panel, speed,
                new AlarmPanel(root, bell, sounder));
        return root;
    }

    @Override
    public void onStop() {
        super.onStop();
        sounder.release();
    }

    @Override
    public void onSaveInstanceState(Bundle state) {
        super.onSaveInstanceState(state);
        state.putStringArray(SILENCED, bell.silenced());
        PanelSwitch.keep(state, screen == null ? panel : screen.panel(panel));
    }

    @Override
    public void onDestroyView() {
        if (screen != null) {
            panel = screen.panel(panel);
            screen.close();
            screen = null;
        }
        super.onDestroyView();
    }

    @Override
    protected void onGround(TelemetryService.Ground newGround) {
        speed.clear();
        if (screen != null) {
            screen.setGround(newGround);
        }
    }

    @Override
    protected void showNewest() {
        if (screen != null) {
            screen.showNewest(GroundSnapshot.of(ground()));
        }
    }

    @Override
    protected void showAll() {
        if (screen != null) {
            screen.showAll(GroundSnapshot.of(ground()));
        }
    }
}
