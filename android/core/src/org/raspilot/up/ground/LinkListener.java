package org.raspilot.up.ground;

import org.raspilot.up.wire.GeneralMessage;

/** Hears what becomes of a {@link GroundLink} and what comes over it. */
interface LinkListener {
    /** Takes a message from the aircraft. */
    void onMessage(GeneralMessage message);

    /** Hears that the link is open: messages can go. */
    void onOpened();

    /** Hears that a link which was open is gone. */
    void onLost(String reason);

    /** Hears that something of the link's facts has changed. */
    void onLink();
}
