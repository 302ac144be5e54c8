package org.raspilot.up.android.api23;

import android.app.PendingIntent;

/** Flags of pending intents (API 23; Android 12 demands one of the two). */
public final class Pending {
    private Pending() {
    }

    /** Returns the flag that prevents other applications from filling in an intent. */
    public static int immutable() {
        return PendingIntent.FLAG_IMMUTABLE;
    }
}
