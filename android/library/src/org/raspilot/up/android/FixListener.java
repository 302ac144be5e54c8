package org.raspilot.up.android;

import org.raspilot.up.providers.Fix;

/** Receives the fixes in addition to the provider that sends them. Called on any thread. */
public interface FixListener {
    /** Takes a fix, possibly an old one from before the start. */
    void onFix(Fix fix);
}
