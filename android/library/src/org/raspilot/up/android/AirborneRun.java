package org.raspilot.up.android;

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
import org.raspilot.up.android.SensorProblem.SensorTexts;
import org.raspilot.up.loop.SelectorLoop;
import org.raspilot.up.net.Endpoint;
import org.raspilot.up.providers.Mounting;
import org.raspilot.up.providers.Sensors;

/**
 * One run of the airborne side, from start to stop: its loop, the sensors' thread, the locks that
 * keep the phone awake. Created, started and ended on the main thread; it is not restarted.
 */
final class AirborneRun {
    private static final String TAG = "Up";
    private static final long STATUS_MS = 500;

    private final Handler main = new Handler(Looper.getMainLooper());
    private final BaseUpService service;
    private final SelectorLoop loop;
    private final HandlerThread sensorsThread;
    private final AndroidSpeaker speaker;
    private final AwakeLocks locks;
    private final NetworkWatch network;
    private final WifiBinding way;
    private final Airborne airborne;
    private boolean isEnded;

    /**
     * Finds the available sensors and starts to read and to connect.
     *
     * @throws IllegalStateException when this process has another Up: nothing runs then
     */
    AirborneRun(BaseUpService service) throws IOException {
        this.service = service;
        AirborneSettings settings = service.readSettings();
        SensorTexts texts = service.sourceTexts();
        loop = new SelectorLoop("up", fault ->
                Log.e(TAG, "up failed in a call", fault), new SleepClock());
        loop.start();
        sensorsThread = new HandlerThread("up sensors", Process.THREAD_PRIORITY_FOREGROUND);
        sensorsThread.start();
        ProblemListener problems = sentence -> reportEvent(sentence);
        Sensors sensors = AndroidSources.find(service, sensorsThread.getLooper(), loop,
                texts, problems, new Declination(deg -> setDeclination(deg)));
        speaker = new AndroidSpeaker(service, texts, problems);
        locks = new AwakeLocks(service);
        way = new WifiBinding(new ProcessWifi(service), service.isOnWifi(), settings.host);
        network = new NetworkWatch(service, () -> onNetworkChanged());
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
            service.onUp(airborne.up());
        } catch (RuntimeException fault) {
            Log.e(TAG, "the application's own set-up failed", fault);
            reportEvent("The application's own set-up failed: " + fault);
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

    void zeroAltitudeHere() {
        loop.post(() -> {
            try {
                final double hPa = airborne.zeroAltitudeHere();
                runOnMain(() -> service.onReferencePressure(hPa));
            } catch (IllegalStateException refusal) {
                reportEvent(refusal.getMessage());
            }
        });
    }

    /** Takes the pressure at altitude zero, hPa. */
    void setReferencePressureHPa(final double hPa) {
        loop.post(() -> airborne.setReferencePressureHPa(hPa));
    }

    private void setDeclination(final double deg) {
        loop.post(() -> airborne.setDeclinationDeg(deg));
    }

    private void onNetworkChanged() {
        loop.post(() -> {
            way.networksChanged();
            checkBinding(airborne.status());
            airborne.networkChanged();
        });
    }

    private void tick() {
        loop.schedule(STATUS_MS, () -> tick());
        AirborneStatus status = airborne.status();
        if (checkBinding(status)) {
            airborne.networkChanged();
        }
        reportStatus(status);
    }

    /** Returns whether the network path has changed. */
    private boolean checkBinding(AirborneStatus status) {
        return way.check(loop.nowMs(), status.isConnected ? status.endpoint.host : null);
    }

    private void reportStatus(final AirborneStatus status) {
        runOnMain(() -> service.report(status));
    }

    private void reportEvent(final String sentence) {
        runOnMain(() -> service.onEvent(sentence));
    }

    /** Runs a call on the main thread, unless the run has ended by then. */
    private void runOnMain(final Runnable call) {
        main.post(() -> {
            if (!isEnded) {
                call.run();
            }
        });
    }

    /** Receives the events of the airborne side on the loop. */
    private final class Listener implements AirborneListener {
        @Override
        public void onConnected(Endpoint place) {
            reportStatus(airborne.status());
            reportEvent(airborne.status().linkText);
        }

        @Override
        public void onDisconnected(String code, String reason) {
            reportStatus(airborne.status());
            reportEvent(reason);
        }

        @Override
        public void onPanic(long delayMs) {
            reportStatus(airborne.status());
        }

        @Override
        public void onEvent(String code, String sentence) {
            reportEvent(sentence);
        }
    }
}
