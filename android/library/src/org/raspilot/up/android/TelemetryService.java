package org.raspilot.up.android;

import android.app.Service;
import android.content.Intent;
import android.os.Binder;
import android.os.IBinder;
import android.os.SystemClock;
import java.io.IOException;
import org.raspilot.up.Up;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.ground.Answer.AnswerListener;
import org.raspilot.up.ground.Answer;
import org.raspilot.up.ground.GroundSettings;
import org.raspilot.up.ground.GroundSide;
import org.raspilot.up.ground.TelemetrySource;

/**
 * Receives telemetry and sends Commands while a client is bound (thesis 4.5.2): a bound service. An
 * application extends it and names its subclass in its manifest.
 */
public abstract class TelemetryService extends Service {
    private final GroundView view = new GroundView();
    private final Ground ground = new Ground();
    private GroundRun run;
    private String fault = "";

    /**
     * Returns the current settings; called at the service's start and at {@link Ground#reload}.
     *
     * @throws IllegalArgumentException with a sentence for the user: the link stays closed then
     */
    protected abstract GroundSettings readSettings();

    /**
     * Returns whether sockets stay on a Wi-Fi whose network contains the peer, from Android 6 on,
     * as for an aircraft's own access point without internet.
     */
    protected boolean isOnWifi() {
        return false;
    }

    /** Registers the application's own handlers, as a BaseTelemetryHandler; on the loop. */
    protected void onUp(Up up, TelemetrySource telemetry) {
    }

    @Override
    public void onCreate() {
        super.onCreate();
        begin();
    }

    @Override
    public IBinder onBind(Intent intent) {
        return ground;
    }

    @Override
    public void onDestroy() {
        end();
        super.onDestroy();
    }

    private void begin() {
        fault = "";
        try {
            run = new GroundRun(this, view);
        } catch (IllegalArgumentException | IOException failure) {
            fault = failure.getMessage();
        }
    }

    private void end() {
        if (run != null) {
            run.end();
            run = null;
        }
    }

    /** What a screen reaches of the service that it is bound to. On the main thread. */
    public final class Ground extends Binder {
        public void add(GroundWatcher watcher) {
            view.add(watcher);
        }

        /** Takes a watcher away; answers that are due to it come all the same. */
        public void remove(GroundWatcher watcher) {
            view.remove(watcher);
        }

        /** Returns the error of the settings as a sentence; empty if they are valid. */
        public String fault() {
            return fault;
        }

        /** Closes the link and restarts it with the current settings. */
        public void reload() {
            end();
            view.clear();
            begin();
        }

        /** Returns the newest state, with the time to compute ages with. */
        public GroundSnapshot snapshot() {
            return view.snapshot().at(run == null ? SystemClock.elapsedRealtime() : run.nowMs());
        }

        /** Sends a Command; {@code shownBeacon} is that of the frame on the screen, or null. */
        public void send(final BaseCommand command, final Long shownBeacon,
                AnswerListener listener) {
            request(command.name(), listener, (side, answers) ->
                    side.send(command, shownBeacon, answers));
        }

        public void requestGains(AnswerListener listener) {
            request(Commands.PIDS, listener, (side, answers) -> side.gains().request(answers));
        }

        public void setGains(final GainSet gains, final Long shownBeacon,
                AnswerListener listener) {
            request(Commands.PIDS, listener, (side, answers) ->
                    side.gains().set(gains, shownBeacon, answers));
        }

        /** Sets what flew before the newest set. */
        public void undoGains(final Long shownBeacon, AnswerListener listener) {
            request(Commands.PIDS, listener, (side, answers) ->
                    side.gains().undo(shownBeacon, answers));
        }

        public void requestControl() {
            post(side -> side.requestControl());
        }

        /** Hands the seat to the ground of a number. */
        public void giveControl(final int to) {
            post(side -> side.giveControl(to));
        }

        public void releaseControl() {
            post(side -> side.releaseControl());
        }

        private void post(GroundRun.Call call) {
            if (run != null) {
                run.post(call);
            }
        }

        private void request(String name, AnswerListener listener, final Asking asking) {
            if (run == null) {
                listener.onAnswer(Answer.refused(name, "no_link", fault));
                return;
            }
            final AnswerListener answers = run.onMain(listener);
            run.post(side -> asking.ask(side, answers));
        }
    }

    /** A request to the aircraft, on the loop. */
    private interface Asking {
        void ask(GroundSide side, AnswerListener answers);
    }

    /** Is told of newer data, for {@link Ground#snapshot}. Called on the main thread. */
    public interface GroundWatcher {
        /** Called for the newest frame; older ones that were not delivered yet are skipped. */
        void onTelemetry();

        /** Called when status, track, events, alarms or gains have changed. */
        void onChanged();
    }
}
