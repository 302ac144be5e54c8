package org.raspilot.up.android;

import android.Manifest;
import android.content.Context;
import android.location.Location;
import android.location.LocationListener;
import android.location.LocationManager;
import android.os.Bundle;
import android.os.Looper;
import android.os.SystemClock;
import java.util.concurrent.Executor;
import org.raspilot.up.providers.Fix;
import org.raspilot.up.providers.SensorListener;
import org.raspilot.up.providers.SensorSource;

/**
 * Where the phone is: by its GPS, and by the network while the GPS is silent, to be told from it
 * by its accuracy. Permission and hardware are looked at anew at each question: both change.
 */
final class LocationSource implements SensorSource<Fix>, LocationListener {
    private static final String[] PROVIDERS = {
        LocationManager.GPS_PROVIDER, LocationManager.NETWORK_PROVIDER,
    };

    private final Context context;
    private final LocationManager manager;
    private final Looper looper;
    private final SourceTexts texts;
    private final ProblemListener problems;
    private final FixListener besides;
    private final Handover<Fix> handover;
    private final FixChoice choice = new FixChoice();

    LocationSource(Context context, Looper looper, Executor loop, SourceTexts texts,
            ProblemListener problems, FixListener besides) {
        this.context = context;
        this.looper = looper;
        this.texts = texts;
        this.problems = problems;
        this.besides = besides;
        manager = (LocationManager) context.getSystemService(Context.LOCATION_SERVICE);
        handover = new Handover<Fix>(loop);
    }

    @Override
    public boolean isPresent() {
        return lack() == null;
    }

    @Override
    public String name() {
        Lack lack = lack();
        return lack == null ? providers() : texts.of(lack);
    }

    @Override
    public void subscribe(long periodMs, SensorListener<Fix> listener) {
        unsubscribe();
        handover.to(listener);
        choice.forget();
        boolean isAnyOn = false;
        for (String provider : PROVIDERS) {
            isAnyOn |= has(provider) && begin(provider, periodMs);
        }
        if (!isAnyOn) {
            problems.onProblem(texts.of(Lack.LOCATION_OFF));
        }
    }

    @Override
    public void unsubscribe() {
        handover.to(null);
        if (manager != null) {
            manager.removeUpdates(this);
        }
    }

    @Override
    public void onLocationChanged(Location location) {
        boolean isGps = LocationManager.GPS_PROVIDER.equals(location.getProvider());
        if (choice.takes(isGps, SystemClock.elapsedRealtime())) {
            Fix fix = fix(location);
            handover.give(fix);
            besides.onFix(fix);
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
        if (LocationManager.GPS_PROVIDER.equals(provider)) {
            problems.onProblem(texts.of(Lack.LOCATION_OFF));
        }
    }

    /** Returns the fix of the system's location; what that does not know is null. */
    static Fix fix(Location location) {
        return new Fix(location.getLatitude(), location.getLongitude(),
                location.hasAltitude() ? Double.valueOf(location.getAltitude()) : null,
                location.hasAccuracy() ? Double.valueOf(location.getAccuracy()) : null,
                location.hasSpeed() ? Double.valueOf(location.getSpeed()) : null,
                location.hasBearing() ? Double.valueOf(location.getBearing()) : null);
    }

    private Lack lack() {
        if (manager == null || providers().isEmpty()) {
            return Lack.LOCATION;
        }
        boolean isPermitted = Permissions.has(context, Manifest.permission.ACCESS_FINE_LOCATION)
                || Permissions.has(context, Manifest.permission.ACCESS_COARSE_LOCATION);
        return isPermitted ? null : Lack.LOCATION_PERMISSION;
    }

    private String providers() {
        StringBuilder names = new StringBuilder();
        for (String provider : PROVIDERS) {
            if (has(provider)) {
                names.append(names.length() == 0 ? "" : ", ").append(provider);
            }
        }
        return names.toString();
    }

    private boolean has(String provider) {
        return manager != null && manager.getAllProviders().contains(provider);
    }

    /** Begins with one provider; returns whether it may and is switched on. */
    private boolean begin(String provider, long periodMs) {
        try {
            Location known = manager.getLastKnownLocation(provider);
            if (known != null) {
                besides.onFix(fix(known));
            }
            manager.requestLocationUpdates(provider, periodMs, 0, this, looper);
            return manager.isProviderEnabled(provider);
        } catch (SecurityException refusal) {
            // Only the coarse location is permitted: no GPS then.
            problems.onProblem(texts.of(Lack.LOCATION_PERMISSION) + ": " + provider);
            return false;
        }
    }
}
