package org.raspilot.up.android;

import org.raspilot.up.airborne.AirborneStatus;

/** Sees what the airborne side does. Called on the main thread. */
public interface UpWatcher {
    /** Takes the current status: twice a second, and soon after a change of the link. */
    void onStatus(AirborneStatus status);
}
