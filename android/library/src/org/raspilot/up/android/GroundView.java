package org.raspilot.up.android;

import android.os.Handler;
import android.os.Looper;
import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.android.TelemetryService.GroundWatcher;
import org.raspilot.up.ground.Alarms;
import org.raspilot.up.ground.EventLog;
import org.raspilot.up.ground.GainsService;
import org.raspilot.up.ground.GroundStatus;
import org.raspilot.up.ground.Telemetry;
import org.raspilot.up.ground.Track;

/**
 * The newest state of the ground side, and the watchers on the main thread. Taken from the loop; a
 * watcher that is slower than the aircraft receives only the newest state.
 */
final class GroundView implements Runnable {
    private final Handler main = new Handler(Looper.getMainLooper());
    private final List<GroundWatcher> watchers = new ArrayList<>();
    private final Object lock = new Object();
    private boolean isPosted;
    private boolean isTelemetryNew;
    private boolean isChanged;
    private GroundSnapshot snapshot = GroundSnapshot.EMPTY;

    /** Adds a watcher; on the main thread. */
    void add(GroundWatcher watcher) {
        if (!watchers.contains(watcher)) {
            watchers.add(watcher);
        }
    }

    /** Takes a watcher away; on the main thread. */
    void remove(GroundWatcher watcher) {
        watchers.remove(watcher);
    }

    void update(Telemetry newest) {
        synchronized (lock) {
            snapshot = new GroundSnapshot(newest, snapshot.status, snapshot.track,
                    snapshot.events, snapshot.alarms, snapshot.gains, 0);
            isTelemetryNew = true;
            wake();
        }
    }

    void update(GroundStatus newest) {
        synchronized (lock) {
            change(new GroundSnapshot(snapshot.telemetry, newest, snapshot.track,
                    snapshot.events, snapshot.alarms, snapshot.gains, 0));
        }
    }

    void update(Track.Snapshot track, EventLog.Snapshot events, Alarms.Snapshot alarms,
            GainsService.Snapshot gains) {
        synchronized (lock) {
            change(new GroundSnapshot(snapshot.telemetry, snapshot.status, track, events,
                    alarms, gains, 0));
        }
    }

    /** Clears everything, as before another link; the watchers are notified. */
    void clear() {
        synchronized (lock) {
            isTelemetryNew = true;
            change(GroundSnapshot.EMPTY);
        }
    }

    GroundSnapshot snapshot() {
        synchronized (lock) {
            return snapshot;
        }
    }

    @Override
    public void run() {
        final boolean hasTelemetry;
        final boolean hasChange;
        synchronized (lock) {
            hasTelemetry = isTelemetryNew;
            hasChange = isChanged;
            isTelemetryNew = false;
            isChanged = false;
            isPosted = false;
        }
        for (GroundWatcher watcher : new ArrayList<>(watchers)) {
            if (hasTelemetry) {
                watcher.onTelemetry();
            }
            if (hasChange) {
                watcher.onChanged();
            }
        }
    }

    private void change(GroundSnapshot now) {
        snapshot = now;
        isChanged = true;
        wake();
    }

    private void wake() {
        if (!isPosted) {
            isPosted = true;
            main.post(this);
        }
    }
}
