package org.raspilot.up.commands;

import org.raspilot.up.wire.GeneralMessage;

/**
 * Receives the answers to the Commands of one link; one object for the whole life of the link.
 *
 * <p>The receiver remembers ids by this object, so it outlives the link's connections.
 */
public interface AnswerSink {
    /** Sends an {@code up.ack} or {@code up.nack} if possible. */
    void answer(GeneralMessage answer);
}
