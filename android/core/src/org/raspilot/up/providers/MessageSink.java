package org.raspilot.up.providers;

import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.wire.OrientationFrame;

/** The destination of a provider's data: the links to the Raspberry Pi. */
public interface MessageSink {
    /**
     * Sends a Command; it replaces one under the same key that still waits for a slow link.
     *
     * @param key the provider's name
     * @return whether the link accepted it; false: not connected, and nothing is kept
     * @throws IllegalArgumentException for invalid data: NaN, or more than 16 KiB
     */
    boolean sendNewest(String key, BaseCommand command);

    /** Sends an orientation frame, newest wins; returns whether the link took it. */
    boolean sendOrientation(OrientationFrame frame);

    boolean isOpen();

    boolean isOrientationOpen();
}
