package org.raspilot.up.android;

import android.util.Log;
import org.raspilot.up.loop.FaultListener;

/** Writes faults of what runs on a loop into the system's log: they are bugs. */
final class Faults implements FaultListener {
    private static final String TAG = "Up";

    private final String name;

    Faults(String name) {
        this.name = name;
    }

    @Override
    public void onFault(Throwable fault) {
        Log.e(TAG, name + " failed in a call", fault);
    }
}
