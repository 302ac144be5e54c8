package org.raspilot.up.airborne;

import java.util.List;
import org.raspilot.up.airborne.AirborneSettings.AirborneMode;
import org.raspilot.up.providers.AltitudeProvider;
import org.raspilot.up.providers.OrientationProvider;
import org.raspilot.up.wire.Hello;

/** What settings must be; each rule raises IllegalArgumentException with a sentence. */
final class SettingsRules {
    private static final int MAX_HOST_LENGTH = 253;
    private static final int MIN_PERIOD_MS = 20;
    private static final int MAX_PERIOD_MS = 10000;

    private SettingsRules() {}

    static void check(AirborneSettings settings) {
        present("the mode", settings.mode);
        present("the way of orientation", settings.orientation);
        present("the mounting", settings.mounting);
        host("the host", settings.host);
        host("the runner's host", settings.runnerHost);
        hosts(settings.discoveryHosts);
        port("the port of the Raspberry Pi", settings.generalPort);
        port("the port for orientation", settings.orientationPort);
        port("the port of Discovery", settings.discoveryPort);
        port("the runner's port", settings.runnerPort);
        aircraft(settings.aircraft);
        profile(settings.profile);
        whole("the rate of orientation (Hz)", settings.orientationHz,
                OrientationProvider.MIN_HZ, OrientationProvider.MAX_HZ);
        period("the period of the location", settings.locationPeriodMs);
        period("the period of the altitude", settings.altitudePeriodMs);
        period("the period of the heading", settings.headingPeriodMs);
        range("the declination (deg)", settings.declinationDeg, -180, 180);
        range("the reference pressure (hPa)", settings.referencePressureHPa,
                AltitudeProvider.MIN_REFERENCE_HPA, AltitudeProvider.MAX_REFERENCE_HPA);
        boolean isAlone = settings.runnerHost.isEmpty() && settings.host.isEmpty();
        if (settings.mode == AirborneMode.BLACK_BOX && isAlone) {
            throw new IllegalArgumentException(
                    "Black Box Mode needs the runner's host, or that of a running server");
        }
    }

    private static void present(String what, Object value) {
        if (value == null) {
            throw new IllegalArgumentException(what + " is missing");
        }
    }

    private static void hosts(List<String> hosts) {
        for (String host : hosts) {
            host("an address of Discovery", host);
            if (host.isEmpty()) {
                throw new IllegalArgumentException("an address of Discovery is empty");
            }
        }
    }

    private static void host(String what, String host) {
        present(what, host);
        if (host.length() > MAX_HOST_LENGTH) {
            throw new IllegalArgumentException(what + " is longer than " + MAX_HOST_LENGTH);
        }
        for (int at = 0; at < host.length(); at++) {
            char letter = host.charAt(at);
            if (Character.isWhitespace(letter) || Character.isISOControl(letter)
                    || letter == '/') {
                throw new IllegalArgumentException(
                        what + " is a name or an address, without blanks and slashes");
            }
        }
    }

    private static void port(String what, int port) {
        whole(what, port, 1, 65535);
    }

    private static void period(String what, int periodMs) {
        whole(what + " (ms)", periodMs, MIN_PERIOD_MS, MAX_PERIOD_MS);
    }

    private static void whole(String what, int value, int least, int most) {
        if (value < least || value > most) {
            throw new IllegalArgumentException(
                    what + " is " + least + " to " + most + ", not " + value);
        }
    }

    private static void range(String what, double value, double least, double most) {
        if (!(value >= least && value <= most)) {
            throw new IllegalArgumentException(
                    what + " is " + (long) least + " to " + (long) most + ", not " + value);
        }
    }

    private static void aircraft(String name) {
        present("the aircraft's name", name);
        if (!name.isEmpty() && !Hello.isAircraftName(name)) {
            throw new IllegalArgumentException(
                    "the aircraft's name is 1 to 32 of A-Z a-z 0-9 _ . - and no dot first");
        }
    }

    private static void profile(String name) {
        present("the profile", name);
        if (name.length() > 64) {
            throw new IllegalArgumentException("the profile's name is longer than 64");
        }
    }
}
