package org.raspilot.up.android;

import android.hardware.GeomagneticField;
import org.raspilot.up.providers.Fix;

/** Reports the magnetic declination along the flight, by Android's model. */
final class Declination {
    interface Listener {
        /** Takes degrees from magnetic to true north, east positive; on any thread. */
        void onDeclination(double deg);
    }

    /** Within this many degrees of latitude or longitude the angle is the same to 1 deg. */
    private static final double NEAR_DEG = 0.5;

    private final Listener listener;
    private Fix told;

    Declination(Listener listener) {
        this.listener = listener;
    }

    /** Takes a fix, possibly an old one from before the start; on any thread. */
    synchronized void onFix(Fix fix) {
        if (told != null && isNear(fix, told)) {
            return;
        }
        told = fix;
        float altitudeM = fix.altitudeM == null ? 0 : fix.altitudeM.floatValue();
        GeomagneticField field = new GeomagneticField((float) fix.latitudeDeg,
                (float) fix.longitudeDeg, altitudeM, System.currentTimeMillis());
        listener.onDeclination(field.getDeclination());
    }

    private static boolean isNear(Fix fix, Fix other) {
        return Math.abs(fix.latitudeDeg - other.latitudeDeg) < NEAR_DEG
                && Math.abs(fix.longitudeDeg - other.longitudeDeg) < NEAR_DEG;
    }
}
