package org.raspilot.up.android;

import org.raspilot.up.ground.Alarms;
import org.raspilot.up.ground.EventLog;
import org.raspilot.up.ground.GainsService;
import org.raspilot.up.ground.GroundStatus;
import org.raspilot.up.ground.Telemetry;
import org.raspilot.up.ground.Track;

/** The known state at a moment, for the parts of a screen; an unknown value is null. Immutable. */
public final class GroundSnapshot {
    static final GroundSnapshot EMPTY =
            new GroundSnapshot(Telemetry.EMPTY, null, null, null, null, null, 0);

    /** The newest frame; {@link Telemetry#EMPTY} before the first. */
    public final Telemetry telemetry;
    public final GroundStatus status;
    public final Track.Snapshot track;
    public final EventLog.Snapshot events;
    public final Alarms.Snapshot alarms;
    public final GainsService.Snapshot gains;
    /** The loop's clock at this moment, ms. */
    public final long nowMs;

    GroundSnapshot(Telemetry telemetry, GroundStatus status, Track.Snapshot track,
            EventLog.Snapshot events, Alarms.Snapshot alarms, GainsService.Snapshot gains,
            long nowMs) {
        this.telemetry = telemetry;
        this.status = status;
        this.track = track;
        this.events = events;
        this.alarms = alarms;
        this.gains = gains;
        this.nowMs = nowMs;
    }

    /** Returns the current state of a ground; empty without one. */
    public static GroundSnapshot of(TelemetryService.Ground ground) {
        return ground == null ? EMPTY : ground.snapshot();
    }

    GroundSnapshot at(long timeMs) {
        return new GroundSnapshot(telemetry, status, track, events, alarms, gains, timeMs);
    }
}
