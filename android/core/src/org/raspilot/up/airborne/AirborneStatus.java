package org.raspilot.up.airborne;

import java.util.List;
import org.raspilot.up.net.Place;
import org.raspilot.up.providers.ProviderStatus;

/** What the airborne screen shows: a snapshot that never changes, for any thread. */
public final class AirborneStatus {
    private final boolean isRunning;
    private final boolean isConnected;
    private final String linkText;
    private final Place place;
    private final AirborneMode mode;
    private final OrientationTransport orientation;
    private final double orientationHz;
    private final long panicDelayMs;
    private final List<ProviderStatus> providers;
    private final long telemetry;
    private final long executed;
    private final long refused;
    private final long malformed;
    private final long connections;

    AirborneStatus(
            boolean isRunning,
            boolean isConnected,
            String linkText,
            Place place,
            AirborneMode mode,
            OrientationTransport orientation,
            double orientationHz,
            long panicDelayMs,
            List<ProviderStatus> providers,
            long telemetry,
            long executed,
            long refused,
            long malformed,
            long connections) {
        this.isRunning = isRunning;
        this.isConnected = isConnected;
        this.linkText = linkText;
        this.place = place;
        this.mode = mode;
        this.orientation = orientation;
        this.orientationHz = orientationHz;
        this.panicDelayMs = panicDelayMs;
        this.providers = providers;
        this.telemetry = telemetry;
        this.executed = executed;
        this.refused = refused;
        this.malformed = malformed;
        this.connections = connections;
    }

    /** Returns whether it was started. */
    public boolean isRunning() {
        return isRunning;
    }

    /** Returns whether the link for Commands is connected. */
    public boolean isConnected() {
        return isConnected;
    }

    /** Returns the state of the link in one sentence. */
    public String linkText() {
        return linkText;
    }

    /** Returns where it is, or was last, connected to; null: never. */
    public Place place() {
        return place;
    }

    /** Returns who it speaks to. */
    public AirborneMode mode() {
        return mode;
    }

    /** Returns how orientation leaves. */
    public OrientationTransport orientation() {
        return orientation;
    }

    /** Returns orientation frames in the last second. */
    public double orientationHz() {
        return orientationHz;
    }

    /** Returns the delay of Panic Mode, ms; 0: none. */
    public long panicDelayMs() {
        return panicDelayMs;
    }

    /** Returns each provider, in the order of registration. */
    public List<ProviderStatus> providers() {
        return providers;
    }

    /** Returns telemetry messages that came. */
    public long telemetry() {
        return telemetry;
    }

    /** Returns commands that were executed. */
    public long executed() {
        return executed;
    }

    /** Returns commands that were refused. */
    public long refused() {
        return refused;
    }

    /** Returns lines dropped because they were no General Messages. */
    public long malformed() {
        return malformed;
    }

    /** Returns how often the link came. */
    public long connections() {
        return connections;
    }
}
