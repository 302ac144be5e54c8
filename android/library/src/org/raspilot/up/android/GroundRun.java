package org.raspilot.up.android;

import android.os.Handler;
import android.os.Looper;
import android.util.Log;
import java.io.IOException;
import java.util.Random;
import org.raspilot.up.Up;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandExecutor.HandlerFaultListener;
import org.raspilot.up.commands.CommandHandler;
import org.raspilot.up.ground.Answer.AnswerListener;
import org.raspilot.up.ground.GroundListener;
import org.raspilot.up.ground.GroundSettings;
import org.raspilot.up.ground.GroundSide;
import org.raspilot.up.ground.GroundStatus.LinkState;
import org.raspilot.up.ground.GroundStatus;
import org.raspilot.up.ground.Telemetry;
import org.raspilot.up.loop.SelectorLoop;

/**
 * One run of the ground side on its own loop. Created, used and ended on the main thread, which
 * receives its changes; when the loop is faster than the main thread, only the newest state is
 * delivered.
 */
final class GroundRun implements GroundListener, HandlerFaultListener {
    /** Something to do with the ground side on its loop. */
    interface Call {
        void with(GroundSide side);
    }

    private static final String TAG = "Up";

    private final Handler main = new Handler(Looper.getMainLooper());
    private final SelectorLoop loop;
    private final GroundSide side;
    private final NetworkWatch network;
    private final WifiBinding way;
    private final String host;
    private final GroundView view;
    private final Up up;
    private volatile boolean isEnded;

    /** Starts to connect; the view receives the changes. */
    GroundRun(TelemetryService service, GroundView view) throws IOException {
        this.view = view;
        final GroundSettings settings = service.readSettings();
        way = new WifiBinding(new ProcessWifi(service), service.isOnWifi(), settings.host);
        loop = new SelectorLoop("up ground", fault ->
                Log.e(TAG, "up ground failed in a call", fault), new SleepClock());
        loop.start();
        up = new Up(loop, this);
        side = new GroundSide(loop, settings, new PreferencesTokenStore(service),
                up.commandExecutor(), this, new Random());
        host = settings.host;
        network = new NetworkWatch(service, () -> onNetworkChanged());
        loop.post(() -> {
            setUp(service);
            side.start();
            onStatus(side.status());
            onChanged();
        });
        network.begin();
    }

    /** Runs the application's own setup; a failure there does not stop the rest. */
    private void setUp(TelemetryService service) {
        try {
            service.onUp(up, side);
        } catch (RuntimeException fault) {
            Log.e(TAG, "the application's own set-up failed", fault);
        }
    }

    /** Ends everything; outstanding answers report a lost link. */
    void end() {
        isEnded = true;
        network.end();
        loop.post(() -> {
            try {
                side.stop();
            } finally {
                way.end();
                loop.stop();
            }
        });
    }

    /** Returns the loop's clock, ms. */
    long nowMs() {
        return loop.nowMs();
    }

    /** Does something with the ground side on its loop. */
    void post(final Call call) {
        loop.post(() -> call.with(side));
    }

    /** Returns a listener for the loop that hands the answer to one on the main thread. */
    AnswerListener onMain(final AnswerListener listener) {
        return answer -> main.post(() -> listener.onAnswer(answer));
    }

    @Override
    public void onTelemetry(Telemetry telemetry) {
        if (!isEnded) {
            view.update(telemetry);
        }
    }

    @Override
    public void onStatus(GroundStatus status) {
        if (!isEnded) {
            view.update(status);
            if (checkBinding(status)) {
                onNetworkChanged();
            }
        }
    }

    @Override
    public void onChanged() {
        if (!isEnded) {
            view.update(side.track().snapshot(), side.events().snapshot(),
                    side.alarms().snapshot(), side.gains().snapshot());
        }
    }

    @Override
    public void onHandlerFailed(CommandHandler handler, BaseCommand command,
            Throwable fault) {
        Log.e(TAG, handler.getClass().getName() + " failed at " + command.name(), fault);
    }

    /** Returns whether the network path has changed. */
    private boolean checkBinding(GroundStatus status) {
        return way.check(loop.nowMs(), status.link == LinkState.OPEN ? host : null);
    }

    private void onNetworkChanged() {
        post(ground -> {
            way.networksChanged();
            checkBinding(ground.status());
            ground.reconnectNow();
        });
    }
}
