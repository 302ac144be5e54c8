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
    private Telemetry telemetry = Telemetry.EMPTY;
    private GroundStatus status;
    private Track.Snapshot track;
    private EventLog.Snapshot events;
    private Alarms.Snapshot alarms;
    private GainsService.Snapshot gains;

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
            telemetry = newest;
            isTelemetryNew = true;
            wake();
        }
    }

    void update(GroundStatus newest) {
        synchronized (lock) {
            status = newest;
            isStatusNew = true;
            wake();
        }
    }

    void update(Track.Snapshot newTrack, EventLog.Snapshot newEvents, Alarms.Snapshot newAlarms,
            GainsService.Snapshot newGains) {
        synchronized (lock) {
            track = newTrack;
            events = newEvents;
            alarms = newAlarms;
            gains = newGains;
            isChanged = true;
            wake();
        }
    }

    /** Clears everything, as before another link; the watchers are notified. */
    void clear() {
        synchronized (lock) {
            telemetry = Telemetry.EMPTY;
            status = null;
            track = null;
            events = null;
            alarms = null;
            gains = null;
            isTelemetryNew = true;
            isChanged = true;
            wake();
        }
    }

    Telemetry telemetry() {
        synchronized (lock) {
            return telemetry;
        }
    }

    GroundStatus status() {
        synchronized (lock) {
            return status;
        }
    }

    Track.Snapshot track() {
        synchronized (lock) {
            return track;
        }
    }

    EventLog.Snapshot events() {
        synchronized (lock) {
            return events;
        }
    }

    Alarms.Snapshot alarms() {
        synchronized (lock) {
            return alarms;
        }
    }

    GainsService.Snapshot gains() {
        synchronized (lock) {
            return gains;
        }
    }

    @Override
    public void run() {
        final Telemetry newTelemetry;
        final GroundStatus newStatus;
        final boolean isOtherNew;
        synchronized (lock) {
            newTelemetry = isTelemetryNew ? telemetry : null;
            newStatus = isStatusNew ? status : null;
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
