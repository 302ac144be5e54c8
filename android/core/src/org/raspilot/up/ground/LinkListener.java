package org.raspilot.up.ground;

import org.raspilot.up.wire.GeneralMessage;

/** Receives the events and messages of a {@link GroundLink}. */
interface LinkListener {
    /** Takes a message from the aircraft. */
    void onMessage(GeneralMessage message);

    /** Called when the link is open: messages can be sent. */
    void onOpened();

    /** Called when an open link is lost. */
    void onLost(String reason);

    /** Called when a part of the link's state has changed. */
    void onLink();
}
