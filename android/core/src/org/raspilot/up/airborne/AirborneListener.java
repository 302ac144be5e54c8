package org.raspilot.up.airborne;

import org.raspilot.up.net.Endpoint;
import org.raspilot.up.net.UpSocketStatus;

/** Receives the events of the airborne side, on the loop. */
public interface AirborneListener {
    /** Called when the link for Commands is open. */
    void onConnected(Endpoint place);

    /** Called when the link is lost; the code is that of {@link UpSocketStatus}. */
    default void onDisconnected(String code, String reason) {
        onDisconnected(reason);
    }

    /** Called when the link is lost, unless the method with the code is overridden. */
    default void onDisconnected(String reason) {
    }

    /** Called when Panic Mode starts, changes or ends (0). */
    void onPanic(long delayMs);

    /**
     * Called for anything else worth logging.
     *
     * @param code {@code nack_received provider_problem handler_failed sensor_silent
     *     sensor_recovered}, or that of {@link UpSocketStatus}: why there is no link
     */
    void onEvent(String code, String sentence);
}
