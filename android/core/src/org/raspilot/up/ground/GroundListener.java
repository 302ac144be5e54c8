package org.raspilot.up.ground;

/** Hears what a {@link GroundSide} knows anew. Called on the loop; all values are immutable. */
public interface GroundListener {
    /**
     * Takes the newest frame. Called for each that comes, and once more for the same frame when
     * its link was lost ({@link Age#isLinkLost}), because everything in it is stale then.
     */
    void onTelemetry(Telemetry telemetry);

    /** Takes the status: when something of it has changed, and each second for its figures. */
    void onStatus(GroundStatus status);

    /** Hears that track, events, alarms or gains have changed: their versions say which. */
    void onChanged();
}
