package org.raspilot.up.android;

import android.content.Context;
import android.os.Handler;
import android.os.HandlerThread;
import android.os.Looper;
import android.os.Process;
import android.util.Log;
import java.io.IOException;
import java.util.Random;
import org.raspilot.up.Up;
import org.raspilot.up.airborne.Airborne;
import org.raspilot.up.airborne.AirborneListener;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.airborne.AirborneStatus;
import org.raspilot.up.loop.SelectorLoop;
import org.raspilot.up.net.Place;
import org.raspilot.up.providers.Mounting;

/**
 * One run of the airborne side, from start to stop: its loop, the sensors' thread, the locks that
 * keep the phone awake. Created, started and ended on the main thread; it is not restarted.
 */
final class AirborneRun {
    /** Receives the events of a run until its end; on the main thread, except {@link #onUp}. */
    interface Host {
        /** Registers handlers and providers; on the loop, before the start. */
        void onUp(Up up);

        void onStatus(AirborneStatus status);

        /** Takes a line of the log. */
        void onEvent(String sentence);

        /** Takes the pressure by which the altitude is zero here, hPa. */
        void onReferencePressure(double hPa);
    }

    private static final String TAG = "Up";
    private static final long STATUS_MS = 500;

    private final Handler main = new Handler(Looper.getMainLooper());
    private final Host host;
    private final SelectorLoop loop;
    private final HandlerThread sensorsThread;
    private final AndroidSpeaker speaker;
    private final AwakeLocks locks;
    private final NetworkWatch network;
    private final WifiWay way;
    private final Airborne airborne;
    private boolean isEnded;

    /**
     * Finds the available sensors and starts to read and to connect.
     *
     * @throws IllegalStateException when this process has another Up: nothing runs then
     */
    AirborneRun(Context context, AirborneSettings settings, boolean isOnWifi, SourceTexts texts,
            Host host) throws IOException {
        this.host = host;
        loop = new SelectorLoop("up", new Faults("up"), new SleepClock());
        loop.start();
        sensorsThread = new HandlerThread("up sensors", Process.THREAD_PRIORITY_FOREGROUND);
        sensorsThread.start();
        ProblemListener problems = sentence -> tellEvent(sentence);
        AndroidSources sensors = new AndroidSources(context, sensorsThread.getLooper(), loop,
                texts, problems, new Declination(deg -> turnNorth(deg)));
        speaker = new AndroidSpeaker(context, texts, problems);
        locks = new AwakeLocks(context);
        way = new WifiWay(new ProcessWifi(context), isOnWifi, settings.host);
        network = new NetworkWatch(context, () -> comeBack());
        airborne = new Airborne(loop, settings, sensors, speaker, new Listener(), new Random());
        begin();
    }

    private void begin() {
        try {
            Up.setInstance(airborne.up());
        } catch (IllegalStateException another) {
            speaker.end();
            sensorsThread.quit();
            loop.stop();
            throw another;
        }
        locks.acquire();
        loop.post(() -> {
            setUp();
            airborne.start();
            tick();
        });
        network.begin();
    }

    /** Runs the application's own setup; a failure there does not stop the rest. */
    private void setUp() {
        try {
            host.onUp(airborne.up());
        } catch (RuntimeException fault) {
            Log.e(TAG, "the application's own set-up failed", fault);
            tellEvent("The application's own set-up failed: " + fault);
        }
    }

    /** Ends everything; nothing is reported afterwards. */
    void end() {
        isEnded = true;
        Up.setInstance(null);
        network.end();
        speaker.end();
        loop.post(() -> {
            try {
                airborne.stop();
            } finally {
                way.end();
                sensorsThread.quit();
                loop.stop();
            }
        });
        locks.release();
    }

    /** Restarts the location, as after a permission was granted or revoked. */
    void restart(final String provider) {
        loop.post(() -> airborne.providers().restart(provider));
    }

    void setMounting(final Mounting mounting) {
        loop.post(() -> airborne.setMounting(mounting));
    }

    /** Sets the altitude at the phone's position to zero. */
    void zeroAltitudeHere() {
        loop.post(() -> {
            try {
                tellPressure(airborne.zeroAltitudeHere());
            } catch (IllegalStateException refusal) {
                tellEvent(refusal.getMessage());
            }
        });
    }

    /** Takes the pressure at altitude zero, hPa. */
    void setReferencePressureHPa(final double hPa) {
        loop.post(() -> airborne.setReferencePressureHPa(hPa));
    }

    private void turnNorth(final double deg) {
        loop.post(() -> airborne.setDeclinationDeg(deg));
    }

    private void comeBack() {
        loop.post(() -> {
            way.networksChanged();
            lookAtWay(airborne.status());
            airborne.networkChanged();
        });
    }

    private void tick() {
        loop.schedule(STATUS_MS, () -> tick());
        AirborneStatus status = airborne.status();
        if (lookAtWay(status)) {
            airborne.networkChanged();
        }
        tellStatus(status);
    }

    /** Returns whether the network path has changed. */
    private boolean lookAtWay(AirborneStatus status) {
        return way.look(loop.nowMs(), status.isConnected ? status.place.host : null);
    }

    private void tellStatus() {
        tellStatus(airborne.status());
    }

    private void tellStatus(final AirborneStatus status) {
        tell(() -> host.onStatus(status));
    }

    private void tellEvent(final String sentence) {
        tell(() -> host.onEvent(sentence));
    }

    private void tellPressure(final double hPa) {
        tell(() -> host.onReferencePressure(hPa));
    }

    /** Runs a call on the main thread, unless the run has ended by then. */
    private void tell(final Runnable call) {
        main.post(() -> {
            if (!isEnded) {
                call.run();
            }
        });
    }

    /** Receives the events of the airborne side on the loop. */
    private final class Listener implements AirborneListener {
        @Override
        public void onConnected(Place place) {
            tellStatus();
            tellEvent(airborne.status().linkText);
        }

        @Override
        public void onDisconnected(String reason) {
            tellStatus();
            tellEvent(reason);
        }

        @Override
        public void onPanic(long delayMs) {
            tellStatus();
        }

        @Override
        public void onEvent(String sentence) {
            tellEvent(sentence);
        }
    }
}
