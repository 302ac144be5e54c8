package org.raspilot.up.android;

import org.raspilot.up.providers.Fix;

/** Hears where the phone is besides the provider that sends it. Called on any thread. */
public interface FixListener {
    /** Takes a fix, perhaps an old one of before the start. */
    void onFix(Fix fix);
}
