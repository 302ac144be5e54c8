package org.raspilot.up.android;

import org.raspilot.up.ground.GroundStatus;
import org.raspilot.up.ground.Telemetry;

/** Receives the data of the aircraft. Called on the main thread. */
public interface GroundWatcher {
    /** Takes the newest frame; older frames that were not delivered yet are skipped. */
    void onTelemetry(Telemetry telemetry);

    /** Takes the status, when it has changed. */
    void onStatus(GroundStatus status);

    /** Called when track, events, alarms or gains have changed. */
    void onChanged();
}
