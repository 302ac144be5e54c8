package org.raspilot.up.ground;

/** Has the newest telemetry. */
public interface TelemetrySource {
    /** Returns the newest frame; {@link Telemetry#EMPTY} before the first. */
    Telemetry telemetry();
}
