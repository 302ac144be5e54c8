package org.raspilot.up.providers;

import java.util.Map;
import org.raspilot.up.wire.OrientationFrame;

/** Where a provider's data goes: the links to the Raspberry Pi. */
public interface Outlet {
    /**
     * Sends a Command; one of the same name that still waits for a slow link is replaced.
     *
     * @param name which Command
     * @param data its fields as the protocol has them
     * @return whether the link took it; false: it is not connected, and nothing is kept
     */
    boolean sendNewest(String name, Map<String, Object> data);

    /** Sends an orientation frame, newest wins; returns whether the link took it. */
    boolean sendOrientation(OrientationFrame frame);

    /** Returns whether the link for Commands is connected. */
    boolean isOpen();

    /** Returns whether the link for orientation is connected. */
    boolean isOrientationOpen();
}
