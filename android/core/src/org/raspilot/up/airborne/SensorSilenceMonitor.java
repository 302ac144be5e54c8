package org.raspilot.up.airborne;

import java.util.HashSet;
import java.util.Set;
import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.providers.ProviderStatus.ProviderState;
import org.raspilot.up.providers.ProviderStatus;
import org.raspilot.up.providers.ProvidersController;

/** Reports when a sensor falls silent and when it delivers again. */
final class SensorSilenceMonitor {
    private static final long PERIOD_MS = 1000;

    private final Loop loop;
    private final ProvidersController providers;
    private final AirborneListener listener;
    private final Set<String> silent = new HashSet<>();
    private final Runnable looking = () -> check();
    private Cancellable timer;

    SensorSilenceMonitor(Loop loop, ProvidersController providers, AirborneListener listener) {
        this.loop = loop;
        this.providers = providers;
        this.listener = listener;
    }

    void start() {
        silent.clear();
        timer = loop.schedule(PERIOD_MS, looking);
    }

    void stop() {
        timer.cancel();
    }

    private void check() {
        timer = loop.schedule(PERIOD_MS, looking);
        for (ProviderStatus status : providers.statuses()) {
            String who = status.name + ": " + status.sensor;
            if (status.state == ProviderState.SILENT) {
                if (silent.add(status.name)) {
                    listener.onEvent("sensor_silent", who + " sends no readings");
                }
            } else if (silent.remove(status.name)) {
                listener.onEvent("sensor_recovered", who + " sends readings again");
            }
        }
    }
}
