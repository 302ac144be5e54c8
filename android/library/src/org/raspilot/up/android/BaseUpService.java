package org.raspilot.up.android;

import android.Manifest;
import android.app.Service;
import android.content.Context;
import android.content.Intent;
import android.os.Binder;
import android.os.Build;
import android.os.IBinder;
import java.io.IOException;
import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.Up;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.airborne.AirborneStatus;
import org.raspilot.up.android.SensorProblem.SensorTexts;
import org.raspilot.up.android.api26.Foreground;
import org.raspilot.up.providers.LocationProvider;
import org.raspilot.up.providers.Mounting;

/**
 * Reads the sensors and sends them without a visible activity (thesis 4.5.2): a started foreground
 * service that continues when the screen is off and when the application is swept away.
 *
 * <p>An application extends it and names its subclass in its manifest. All its own state is on the
 * main thread; the airborne side runs on its own loop ({@link AirborneRun}). Watchers bind to it
 * without creating it.
 */
public abstract class BaseUpService extends Service {
    public static final String ACTION_STOP = "org.raspilot.up.android.STOP";

    private final List<UpWatcher> watchers = new ArrayList<>();
    private final Airside airside = new Airside();
    private ForegroundNotification notice;
    private AirborneRun run;
    private AirborneStatus newest;

    /** Starts a service that extends this; at the user's wish, so from a screen. */
    public static void start(Context context, Class<? extends BaseUpService> service) {
        Intent intent = new Intent(context, service);
        if (Build.VERSION.SDK_INT >= 26) {
            Foreground.start(context, intent);
        } else {
            context.startService(intent);
        }
    }

    /** Stops it; no effect while it does not run. */
    public static void stop(Context context, Class<? extends BaseUpService> service) {
        context.stopService(new Intent(context, service));
    }

    /**
     * Returns the current settings; called at each start, also when the system restarts the
     * service.
     *
     * @throws IllegalArgumentException with a sentence for the user: the service stops then
     */
    protected abstract AirborneSettings readSettings();

    /**
     * Returns whether sockets stay on a Wi-Fi whose network contains the peer, from Android 6 on;
     * the search for the peer uses it too.
     */
    protected abstract boolean isOnWifi();

    protected abstract SensorTexts sourceTexts();

    protected abstract NotificationTexts noticeTexts();

    /** Returns the notification's line for a status; null: nothing is known yet. */
    protected abstract String noticeText(AirborneStatus status);

    /** Takes a message for the log; on the main thread. */
    protected abstract void onEvent(String sentence);

    /** Takes the pressure by which the altitude is zero here, hPa, to keep it in the settings. */
    protected abstract void onReferencePressure(double hPa);

    /** Registers the application's own handlers and providers; on the loop, before the start. */
    protected void onUp(Up up) {
    }

    /** Replaces the mounting immediately; no effect while the service does not run. */
    protected final void setMounting(Mounting mounting) {
        if (run != null) {
            run.setMounting(mounting);
        }
    }

    /** Sets the pressure at altitude zero, hPa, immediately; no effect while not running. */
    protected final void setReferencePressureHPa(double hPa) {
        if (run != null) {
            run.setReferencePressureHPa(hPa);
        }
    }

    @Override
    public void onCreate() {
        super.onCreate();
        notice = new ForegroundNotification(this, noticeTexts());
    }

    @Override
    public int onStartCommand(Intent intent, int flags, int startId) {
        if (intent != null && ACTION_STOP.equals(intent.getAction())) {
            stopSelf();
            return START_NOT_STICKY;
        }
        // Owed within 5 s of each start, whatever comes of it.
        notice.begin(noticeText(newest), usesLocation());
        if (run == null && !begin()) {
            stopSelf();
            return START_NOT_STICKY;
        }
        return START_STICKY;
    }

    @Override
    public IBinder onBind(Intent intent) {
        return airside;
    }

    @Override
    public void onDestroy() {
        if (run != null) {
            run.end();
            run = null;
        }
        watchers.clear();
        stopForeground(true);
        super.onDestroy();
    }

    private boolean begin() {
        try {
            run = new AirborneRun(this);
            return true;
        } catch (IllegalArgumentException | IllegalStateException | IOException failure) {
            onEvent(failure.getMessage());
        }
        return false;
    }

    private boolean usesLocation() {
        return Permissions.has(this, Manifest.permission.ACCESS_FINE_LOCATION)
                || Permissions.has(this, Manifest.permission.ACCESS_COARSE_LOCATION);
    }

    /** Takes the newest status of the run. */
    final void report(AirborneStatus status) {
        newest = status;
        notice.show(noticeText(status));
        for (UpWatcher watcher : new ArrayList<>(watchers)) {
            watcher.onStatus(status);
        }
    }

    /** What a screen reaches of the service that it is bound to. On the main thread. */
    public final class Airside extends Binder {
        /** Adds a watcher, which immediately receives the current state. */
        public void add(UpWatcher watcher) {
            if (!watchers.contains(watcher)) {
                watchers.add(watcher);
            }
            if (newest != null) {
                watcher.onStatus(newest);
            }
        }

        public void remove(UpWatcher watcher) {
            watchers.remove(watcher);
        }

        /** Checks the permissions again: sensors that were not permitted may be readable now. */
        public void permissionsChanged() {
            if (run != null) {
                notice.begin(noticeText(newest), usesLocation());
                run.restart(LocationProvider.NAME);
            }
        }

        /** Sets the altitude here to zero, then calls {@link BaseUpService#onReferencePressure}. */
        public void zeroAltitudeHere() {
            if (run != null) {
                run.zeroAltitudeHere();
            }
        }
    }

    /** Sees what the airborne side does. Called on the main thread. */
    public interface UpWatcher {
        /** Takes the current status: twice a second, and soon after a change of the link. */
        void onStatus(AirborneStatus status);
    }
}
