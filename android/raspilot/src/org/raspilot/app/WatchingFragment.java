package org.raspilot.app;

import android.app.Fragment;
import android.os.Handler;
import org.raspilot.up.android.TelemetryService.GroundWatcher;
import org.raspilot.up.android.TelemetryService;

/**
 * A screen that watches the aircraft from start to stop (thesis 4.5.3).
 *
 * <p>It redraws five times a second, so that stale values are greyed out within a second even when
 * no message arrives. Main thread only.
 */
public abstract class WatchingFragment extends Fragment {
    private static final long TICK_MS = 200;

    private final Handler handler = new Handler();
    private final Runnable tick = new Runnable() {
        @Override
        public void run() {
            showAll();
            handler.postDelayed(this, TICK_MS);
        }
    };
    private final GroundWatcher watcher = new GroundWatcher() {
        @Override
        public void onTelemetry() {
            showNewest();
        }

        @Override
        public void onChanged() {
            showAll();
        }
    };
    private final TelemetryLink.Watcher linkWatcher = newGround -> setGround(newGround);

    private TelemetryLink link;
    private TelemetryService.Ground ground;

    @Override
    public void onStart() {
        super.onStart();
        link = TelemetryLink.of(getActivity());
        link.addWatcher(linkWatcher);
        handler.removeCallbacks(tick);
        tick.run();
    }

    @Override
    public void onStop() {
        handler.removeCallbacks(tick);
        if (link != null) {
            link.removeWatcher(linkWatcher);
            link = null;
        }
        setGround(null);
        super.onStop();
    }

    /** Draws everything with its current age; there may be no view. */
    protected abstract void showAll();

    /** Draws what moves with a frame that has just come; there may be no view. */
    protected abstract void showNewest();

    /** Called with the ground to watch from now on; null: none. */
    protected abstract void onGround(TelemetryService.Ground newGround);

    /** Returns the ground that is watched; null: none. */
    protected final TelemetryService.Ground ground() {
        return ground;
    }

    private void setGround(TelemetryService.Ground newGround) {
        if (ground == newGround) {
            return;
        }
        if (ground != null) {
            ground.remove(watcher);
        }
        ground = newGround;
        onGround(newGround);
        if (newGround != null) {
            newGround.add(watcher);
        }
        showAll();
    }
}
