package org.raspilot.up.android;

import android.os.SystemClock;
import org.raspilot.up.loop.Clock;

/** The phone's clock that includes sleep: System.nanoTime() stops then. */
final class SleepClock implements Clock {
    private static final long NS_IN_MS = 1000000;

    private final SleepCount sleep = new SleepCount();

    @Override
    public long nowNs() {
        long allMs = SystemClock.elapsedRealtime();
        long sleptMs = sleep.totalMs(allMs, SystemClock.uptimeMillis());
        return System.nanoTime() + sleptMs * NS_IN_MS;
    }
}
