package org.raspilot.up.ground;

import org.raspilot.up.loop.Cancellable;
import org.raspilot.up.loop.Loop;

/** Runs when silence starts after a frame, so that silence is reported without another event. */
final class StaleTimer {
    private final Loop loop;
    private final Runnable onSilent;
    private Cancellable timer;

    StaleTimer(Loop loop, Runnable onSilent) {
        this.loop = loop;
        this.onSilent = onSilent;
    }

    /** Waits until this frame expires, instead of the previous one. */
    void restart(Telemetry frame, long nowMs) {
        cancel();
        final Long ageMs = frame.ageMs(nowMs);
        if (ageMs != null && ageMs <= TelemetrySchema.SILENT_MS) {
            timer = loop.schedule(TelemetrySchema.SILENT_MS + 1 - ageMs, onSilent);
        }
    }

    void cancel() {
        if (timer != null) {
            timer.cancel();
            timer = null;
        }
    }
}
