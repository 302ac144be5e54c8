package org.raspilot.up.android;

import org.raspilot.up.ground.GroundStatus;
import org.raspilot.up.ground.Telemetry;

/** Sees what comes from the aircraft. Called on the main thread. */
public interface GroundWatcher {
    /** Takes the newest frame; frames that came meanwhile are left out. */
    void onTelemetry(Telemetry telemetry);

    /** Takes the status, when it has changed. */
    void onStatus(GroundStatus status);

    /** Hears that track, events, alarms or gains have changed. */
    void onChanged();
}
