package org.raspilot.app.ground;

import android.app.Fragment;
import android.os.Bundle;
import android.os.Handler;
import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;

import org.raspilot.app.R;
import org.raspilot.app.TelemetryLink;
import org.raspilot.up.android.GroundWatcher;
import org.raspilot.up.android.TelemetryService;
import org.raspilot.up.ground.GroundStatus;
import org.raspilot.up.ground.Telemetry;

/**
 * The ground screen: instruments, track, state and every value of the telemetry (thesis 4.5.3).
 *
 * <p>It asks how old everything is five times a second, so that what is old looks old within a
 * second even when no message comes. Bound from start to stop; main thread only.
 */
public final class GroundFragment extends Fragment {
    private static final long TICK_MS = 200;
    private static final String SILENCED = "ground.silenced";

    private final Handler handler = new Handler();
    private final AlarmBell bell = new AlarmBell();
    private final GroundSpeed speed = new GroundSpeed();
    private final Runnable tick = new Runnable() {
        @Override
        public void run() {
            showAll();
            handler.postDelayed(this, TICK_MS);
        }
    };
    private final GroundWatcher watcher = new GroundWatcher() {
        @Override
        public void onTelemetry(Telemetry telemetry) {
            showNewest();
        }

        @Override
        public void onStatus(GroundStatus status) {
            showAll();
        }

        @Override
        public void onChanged() {
            showAll();
        }
    };
    private final TelemetryLink.Watcher linkWatcher = new TelemetryLink.Watcher() {
        @Override
        public void onGround(TelemetryService.Ground newGround) {
            take(newGround);
        }

        @Override
        public void onGroundGone() {
            take(null);
        }
    };

    private TelemetryLink link;
    private TelemetryService.Ground ground;
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
        // Only as long as it is to be seen: the window forgets it with the view.
        root.setKeepScreenOn(true);
        screen = new GroundScreen(getActivity(), root, panel, speed,
                new AlarmPanel(root, bell, sounder));
        return root;
    }

    @Override
    public void onStart() {
        super.onStart();
        link = TelemetryLink.of(getActivity());
        link.watch(linkWatcher);
        handler.removeCallbacks(tick);
        tick.run();
    }

    @Override
    public void onStop() {
        handler.removeCallbacks(tick);
        if (link != null) {
            link.unwatch(linkWatcher);
            link = null;
        }
        take(null);
        sounder.release();
        super.onStop();
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

    /** Watches this ground from now on; null: none. */
    private void take(TelemetryService.Ground newGround) {
        if (ground == newGround) {
            return;
        }
        if (ground != null) {
            ground.remove(watcher);
        }
        ground = newGround;
        speed.clear();
        if (screen != null) {
            screen.setGround(newGround);
        }
        if (newGround != null) {
            newGround.add(watcher);
        }
        showAll();
    }

    /** A frame came: what moves, at once; the rest follows with the tick. */
    private void showNewest() {
        if (screen != null) {
            screen.showNewest(Picture.of(ground));
        }
    }

    private void showAll() {
        if (screen != null) {
            screen.showAll(Picture.of(ground));
        }
    }
}
