package org.raspilot.up.airborne;

import org.raspilot.up.net.Place;

/** Is told on the loop what becomes of the airborne side. */
public interface AirborneListener {
    /** Tells that the link for Commands is there. */
    void onConnected(Place place);

    /** Tells that it is gone, and why, in a sentence without a full stop. */
    void onDisconnected(String reason);

    /** Tells that Panic Mode began, changed or ended (0). */
    void onPanic(long delayMs);

    /** Tells what else is worth a line of the log: why there is no link, which sensor is silent. */
    void onEvent(String sentence);
}
