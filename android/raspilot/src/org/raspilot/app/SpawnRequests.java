package org.raspilot.app;

import android.os.Handler;
import android.os.Looper;
import android.os.Message;
import android.os.Messenger;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.android.BaseUpService;
import org.raspilot.up.android.SpawnResult;
import org.raspilot.up.android.SpawnService;
import org.raspilot.up.net.RunnerAnswer;

/**
 * Has an instance spawned and starts the service that connects to it; every answer is a line of
 * the log, whichever screen is seen then. Lives with the process, on the main thread.
 */
final class SpawnRequests {
    private final RaspilotApplication application;
    private final Messenger answers;
    private Runnable watcher;
    private boolean isAsking;

    SpawnRequests(RaspilotApplication application) {
        this.application = application;
        answers = new Messenger(new Handler(Looper.getMainLooper()) {
            @Override
            public void handleMessage(Message message) {
                onResult(SpawnService.result(message));
            }
        });
    }

    boolean isAsking() {
        return isAsking;
    }

    /** Sets what runs when {@link #isAsking} has changed, or null. */
    void setWatcher(Runnable now) {
        watcher = now;
    }

    /** Sends a request; no effect while one waits for its answer. */
    void request(AirborneSettings settings) {
        if (isAsking) {
            return;
        }
        SpawnService.request(application, settings.runnerHost, settings.runnerPort,
                settings.runnerTls != null, settings.aircraft, settings.profile, answers);
        setAsking(true);
    }

    /** Gives up: whatever the answer, nothing is started. */
    void cancel() {
        setAsking(false);
    }

    private void onResult(SpawnResult result) {
        RunnerAnswer answer = result.answer;
        if (answer == null) {
            application.log(application.getString(R.string.spawn_failed, result.sentence,
                    result.code));
        } else {
            application.log(application.getString(R.string.spawn_runs, result.sentence,
                    answer.endpoint));
            if (answer.proxyHost != null) {
                application.log(application.getString(R.string.spawn_proxy, answer.proxyHost,
                        answer.proxyGroundPort));
            }
        }
        boolean isStillWanted = isAsking;
        setAsking(false);
        if (answer != null && isStillWanted) {
            start();
        }
    }

    private void start() {
        try {
            BaseUpService.start(application, RaspilotUpService.class);
        } catch (IllegalStateException refusal) {
            // The user has left the app, and this system starts no service from the background.
            application.log(application.getString(R.string.start_refused));
        }
    }

    private void setAsking(boolean now) {
        isAsking = now;
        if (watcher != null) {
            watcher.run();
        }
    }
}
