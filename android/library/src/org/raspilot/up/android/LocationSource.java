package org.raspilot.up.android;

import android.Manifest;
import android.content.Context;
import android.location.Location;
import android.location.LocationListener;
import android.location.LocationManager;
import android.os.Build;
import android.os.Bundle;
import android.os.Looper;
import java.util.concurrent.Executor;
import org.raspilot.up.android.SensorProblem.SensorTexts;
import org.raspilot.up.android.api23.Api23;
import org.raspilot.up.providers.Fix;
import org.raspilot.up.providers.SensorListener;
import org.raspilot.up.providers.SensorSource;

/**
 * The position of the phone by GPS alone: the network's position may be that of a moved access
 * point, and would become home. Permission and hardware are checked at each call, because both
 * change.
 */
final class LocationSource implements SensorSource<Fix>, LocationListener {
    /** Key of the extras of a fix of GPS: the number of satellites used in it. */
    private static final String SATELLITES = "satellites";

    private static final String GPS = LocationManager.GPS_PROVIDER;

    /** Precise enough for other uses, such as the magnetic declination. */
    private static final String ROUGH = LocationManager.NETWORK_PROVIDER;

    private final Context context;
    private final LocationManager manager;
    private final Looper looper;
    private final SensorTexts texts;
    private final ProblemListener problems;
    private final Declination declination;
    private final LatestReading<Fix> handover;
    private final FixFilter filter = new FixFilter();
    private final BadReadings bad;

    LocationSource(Context context, Looper looper, Executor loop, SensorTexts texts,
            ProblemListener problems, Declination declination) {
        this.context = context;
        this.looper = looper;
        this.texts = texts;
        this.problems = problems;
        this.declination = declination;
        manager = (LocationManager) context.getSystemService(Context.LOCATION_SERVICE);
        handover = new LatestReading<>(loop);
        bad = new BadReadings(problems, texts.of(SensorProblem.REFUSED));
    }

    @Override
    public boolean isPresent() {
        return problem() == null;
    }

    @Override
    public String name() {
        SensorProblem lack = problem();
        return lack == null ? GPS : texts.of(lack);
    }

    @Override
    public void subscribe(long periodMs, SensorListener<Fix> listener) {
        unsubscribe();
        handover.setListener(listener);
        reportRough();
        begin(periodMs);
    }

    @Override
    public void unsubscribe() {
        handover.setListener(null);
        if (manager != null) {
            manager.removeUpdates(this);
        }
    }

    @Override
    public void onLocationChanged(Location location) {
        try {
            Fix fix = fix(location);
            if (filter.takes(ageMs(location), location.getTime())) {
                handover.put(fix);
            }
            declination.onFix(fix);
        } catch (RuntimeException wrong) {
            // Catches every exception: on the system's thread it would end the flight.
            bad.add(GPS, wrong);
        }
    }

    @Override
    public void onStatusChanged(String provider, int status, Bundle extras) {
    }

    @Override
    public void onProviderEnabled(String provider) {
    }

    @Override
    public void onProviderDisabled(String provider) {
        if (GPS.equals(provider)) {
            problems.onProblem(texts.of(SensorProblem.LOCATION_OFF));
        }
    }

    /** Returns the fix of the system's location; what that does not know is null. */
    static Fix fix(Location location) {
        return new Fix(location.getLatitude(), location.getLongitude(),
                location.hasAltitude() ? Double.valueOf(location.getAltitude()) : null,
                location.hasAccuracy() ? Double.valueOf(location.getAccuracy()) : null,
                location.hasSpeed() ? Double.valueOf(location.getSpeed()) : null,
                location.hasBearing() ? Double.valueOf(location.getBearing()) : null,
                Build.VERSION.SDK_INT >= 23 ? Double.valueOf(Api23.ageMs(location)) : null,
                satellites(location));
    }

    /** Returns how many satellites the fix uses; null where the system does not report it. */
    private static Integer satellites(Location location) {
        Bundle extras = location.getExtras();
        boolean isKnown = extras != null && extras.containsKey(SATELLITES);
        return isKnown ? Integer.valueOf(extras.getInt(SATELLITES, -1)) : null;
    }

    private static long ageMs(Location location) {
        return Build.VERSION.SDK_INT >= 23 ? Api23.ageMs(location) : 0;
    }

    private SensorProblem problem() {
        if (!has(GPS)) {
            return SensorProblem.LOCATION;
        }
        // The approximate location alone is blurred by kilometres: not usable in flight.
        boolean isPermitted = Permissions.has(context, Manifest.permission.ACCESS_FINE_LOCATION);
        return isPermitted ? null : SensorProblem.LOCATION_PERMISSION;
    }

    private boolean has(String provider) {
        return manager != null && manager.getAllProviders().contains(provider);
    }

    /** Also reports the phone's last network position, possibly very old. */
    private void reportRough() {
        try {
            Location known = has(ROUGH) ? manager.getLastKnownLocation(ROUGH) : null;
            if (known != null) {
                declination.onFix(fix(known));
            }
        } catch (RuntimeException refusal) {
            // Not permitted, or no fix at all: the GPS will report it.
            bad.add(ROUGH, refusal);
        }
    }

    private void begin(long periodMs) {
        if (!has(GPS)) {
            problems.onProblem(texts.of(SensorProblem.LOCATION));
            return;
        }
        try {
            Location known = manager.getLastKnownLocation(GPS);
            if (known == null) {
                filter.begin();
            } else {
                filter.begin(known.getTime());
                declination.onFix(fix(known));
            }
            manager.requestLocationUpdates(GPS, periodMs, 0, this, looper);
            if (!manager.isProviderEnabled(GPS)) {
                problems.onProblem(texts.of(SensorProblem.LOCATION_OFF));
            }
        } catch (SecurityException refusal) {
            // Taken away between the question and now.
            problems.onProblem(texts.of(SensorProblem.LOCATION_PERMISSION) + ": " + GPS);
        }
    }
}
