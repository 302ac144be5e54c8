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
    private boolean isStatusNew;
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
            snapshot = new GroundSnapshot(snapshot.telemetry, newest, snapshot.track,
                    snapshot.events, snapshot.alarms, snapshot.gains, 0);
            isStatusNew = true;
            wake();
        }
    }

    void update(Track.Snapshot track, EventLog.Snapshot events, Alarms.Snapshot alarms,
            GainsService.Snapshot gains) {
        synchronized (lock) {
            snapshot = new GroundSnapshot(snapshot.telemetry, snapshot.status, track, events,
                    alarms, gains, 0);
            isChanged = true;
            wake();
        }
    }

    /** Clears everything, as before another link; the watchers are notified. */
    void clear() {
        synchronized (lock) {
            snapshot = GroundSnapshot.EMPTY;
            isTelemetryNew = true;
            isChanged = true;
            wake();
        }
    }

    GroundSnapshot snapshot() {
        synchronized (lock) {
            return snapshot;
        }
    }

    @Override
    public void run() {
        final Telemetry newTelemetry;
        final GroundStatus newStatus;
        final boolean isOtherNew;
        synchronized (lock) {
            newTelemetry = isTelemetryNew ? snapshot.telemetry : null;
            newStatus = isStatusNew ? snapshot.status : null;
            isOtherNew = isChanged;
            isTelemetryNew = false;
            isStatusNew = false;
            isChanged = false;
            isPosted = false;
        }
        for (GroundWatcher watcher : new ArrayList<>(watchers)) {
            notifyWatcher(watcher, newStatus, newTelemetry, isOtherNew);
        }
    }

    private static void notifyWatcher(GroundWatcher watcher, GroundStatus status,
            Telemetry telemetry,
            boolean isOtherNew) {
        if (status != null) {
            watcher.onStatus(status);
        }
        if (telemetry != null) {
            watcher.onTelemetry(telemetry);
        }
        if (isOtherNew) {
            watcher.onChanged();
        }
    }

    private void wake() {
        if (!isPosted) {
            isPosted = true;
            main.post(this);
        }
    }
}
