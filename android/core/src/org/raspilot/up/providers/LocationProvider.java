package org.raspilot.up.providers;

import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.Commands;

/** Sends the GPS position of the device: {@code up.location.update}. */
public final class LocationProvider extends SensorProvider<Fix> {
    public static final String NAME = "location";

    private static final long SILENCE_MS = 10000;
    /** A fix of the mobile network, or an approximate one: home and the way back would be wrong. */
    private static final double MAX_ACCURACY_M = 50;

    private static final double MAX_AGE_MS = 60000;
    private static final int MAX_SATELLITES = 255;

    /** Takes the GPS, and how often a fix leaves at most, ms ({@code AirborneSettings}). */
    public LocationProvider(SensorSource<Fix> source, int periodMs) {
        super(NAME, source, RatePolicy.stream(periodMs, SILENCE_MS));
    }

    @Override
    protected BaseCommand read(Fix fix) {
        if (fix.accuracyM != null && fix.accuracyM > MAX_ACCURACY_M) {
            throw new IllegalArgumentException("a fix that may be off by more than "
                    + Math.round(MAX_ACCURACY_M) + " m is not usable in flight");
        }
        return Commands.of(Commands.LOCATION,
                "latitude", Rounded.to(7, fix.latitudeDeg),
                "longitude", Rounded.to(7, fix.longitudeDeg),
                "altitude", rounded(1, fix.altitudeM),
                "accuracy", rounded(1, fix.accuracyM),
                "speed", rounded(2, fix.speedMS),
                "bearing", isKnown(fix.bearingDeg) ? Rounded.direction(fix.bearingDeg) : null,
                "age_ms", isAge(fix.ageMs) ? Rounded.to(0, fix.ageMs) : null,
                "satellites", isCount(fix.satellites) ? fix.satellites.longValue() : null);
    }

    /** A value unknown to GPS must not prevent sending the position. */
    private static Double rounded(int decimals, Double value) {
        return isKnown(value) ? Rounded.to(decimals, value) : null;
    }

    private static boolean isAge(Double ageMs) {
        return isKnown(ageMs) && ageMs >= 0 && ageMs <= MAX_AGE_MS;
    }

    private static boolean isCount(Integer satellites) {
        return satellites != null && satellites >= 0 && satellites <= MAX_SATELLITES;
    }

    private static boolean isKnown(Double value) {
        return value != null && !value.isNaN() && !value.isInfinite();
    }
}
