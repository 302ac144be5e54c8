package org.raspilot.app;

import android.os.Handler;
import android.os.Looper;
import android.os.Message;
import android.os.Messenger;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.android.BaseUpService;
import org.raspilot.up.android.SpawnResult;
import org.raspilot.up.android.SpawnService;

/**
 * Has an instance spawned and starts the service that connects to it; every answer is a line of
 * the log, whichever screen is seen then. Lives with the process, on the main thread.
 */
final class SpawnDesk {
    /** Called when a request starts and ends. */
    interface Watcher {
        /** Called when {@link SpawnDesk#isAsking} has changed. */
        void onSpawning();
    }

    private final RaspilotApplication application;
    private final Messenger answers;
    private Watcher watcher;
    private boolean isAsking;

    SpawnDesk(RaspilotApplication application) {
        this.application = application;
        answers = new Messenger(new Handler(Looper.getMainLooper()) {
            @Override
            public void handleMessage(Message message) {
                take(SpawnService.result(message));
            }
        });
    }

    /** Returns whether a request waits for its answer. */
    boolean isAsking() {
        return isAsking;
    }

    /** Sets the watcher, or null. */
    void watch(Watcher now) {
        watcher = now;
    }

    /** Sends a request; no effect while one waits for its answer. */
    void ask(AirborneSettings settings) {
        if (isAsking) {
            return;
        }
        SpawnService.ask(application, settings.runnerHost, settings.runnerPort,
                settings.aircraft, settings.profile, answers);
        setAsking(true);
    }

    /** Gives up: whatever the answer, nothing is started. */
    void cancel() {
        setAsking(false);
    }

    private void take(SpawnResult result) {
        if (result.isRunning()) {
            application.note(application.getString(R.string.spawn_runs, result.sentence(),
                    result.place()));
            noteProxy(result);
        } else {
            application.note(application.getString(R.string.spawn_failed, result.sentence()));
        }
        boolean isStillWanted = isAsking;
        setAsking(false);
        if (result.isRunning() && isStillWanted) {
            start();
        }
    }

    private void noteProxy(SpawnResult result) {
        if (result.proxyHost() != null && result.proxyPort() > 0) {
            application.note(application.getString(R.string.spawn_proxy, result.proxyHost(),
                    result.proxyPort()));
        }
    }

    private void start() {
        try {
            BaseUpService.start(application, RaspilotUpService.class);
        } catch (IllegalStateException refusal) {
            // The user has left the app, and this system starts no service from the background.
            application.note(application.getString(R.string.start_refused));
        }
    }

    private void setAsking(boolean now) {
        isAsking = now;
        if (watcher != null) {
            watcher.onSpawning();
        }
    }
}
