package org.raspilot.up.android.api23;

import android.location.Location;
import android.os.SystemClock;
import java.util.concurrent.TimeUnit;

/** When a fix was taken, by the phone's own clock (API 17, reached from 23 on). */
public final class FixTime {
    private FixTime() {
    }

    /** Returns the age of a fix, ms; 0 if the system does not report its time. */
    public static long ageMs(Location location) {
        long takenNs = location.getElapsedRealtimeNanos();
        return takenNs <= 0 ? 0
                : TimeUnit.NANOSECONDS.toMillis(SystemClock.elapsedRealtimeNanos() - takenNs);
    }
}
