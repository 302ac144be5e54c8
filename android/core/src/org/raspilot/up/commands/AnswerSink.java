package org.raspilot.up.commands;

import org.raspilot.up.wire.GeneralMessage;

/**
 * Where answers to the Commands of one link go; one object for the whole life of the link.
 *
 * <p>The receiver remembers ids by this object, so it outlives the link's connections.
 */
public interface AnswerSink {
    /** Sends an {@code up.ack} or {@code up.nack} where it can be sent. */
    void answer(GeneralMessage answer);
}
