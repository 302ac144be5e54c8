package org.raspilot.app.ground;

import org.raspilot.up.android.TelemetryService;
import org.raspilot.up.ground.Alarms;
import org.raspilot.up.ground.EventLog;
import org.raspilot.up.ground.GroundStatus;
import org.raspilot.up.ground.Telemetry;
import org.raspilot.up.ground.Track;

/** The known state at a moment, for the parts of a screen. Immutable. */
public final class GroundSnapshot {
    /** The newest frame; {@link Telemetry#EMPTY} before the first. */
    public final Telemetry telemetry;
    /** The status; null before the service is connected. */
    public final GroundStatus status;
    /** The track; null: not known yet. */
    public final Track.Snapshot track;
    /** The events; null: not known yet. */
    public final EventLog.Snapshot events;
    /** The alarms; null: not known yet. */
    public final Alarms.Snapshot alarms;
    /** The loop's clock at this moment, ms. */
    public final long nowMs;

    private GroundSnapshot(TelemetryService.Ground ground) {
        boolean isThere = ground != null;
        telemetry = isThere ? ground.telemetry() : Telemetry.EMPTY;
        status = isThere ? ground.status() : null;
        track = isThere ? ground.track() : null;
        events = isThere ? ground.events() : null;
        alarms = isThere ? ground.alarms() : null;
        nowMs = isThere ? ground.nowMs() : 0;
    }

    /** Returns the current state of a ground; null: no ground, nothing is known. */
    public static GroundSnapshot of(TelemetryService.Ground ground) {
        return new GroundSnapshot(ground);
    }
}
