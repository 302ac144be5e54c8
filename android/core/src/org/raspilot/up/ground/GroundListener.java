package org.raspilot.up.ground;

/** Receives the changes of a {@link GroundSide}. Called on the loop; all values are immutable. */
public interface GroundListener {
    /**
     * Takes the newest frame. Called for each received frame, and again for the same frame when its
     * link was lost ({@link Age#isLinkLost}), because everything in it is stale then.
     */
    void onTelemetry(Telemetry telemetry);

    /** Takes the status: when something of it has changed, and each second for its figures. */
    void onStatus(GroundStatus status);

    /** Called when track, events, alarms or gains have changed; compare their versions. */
    void onChanged();
}
