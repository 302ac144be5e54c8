package org.raspilot.up.airborne;

import org.raspilot.up.airborne.AirborneSettings.OrientationTransport;
import org.raspilot.up.providers.AltitudeProvider;
import org.raspilot.up.providers.BatteryProvider;
import org.raspilot.up.providers.HeadingProvider;
import org.raspilot.up.providers.LocationProvider;
import org.raspilot.up.providers.Mounting;
import org.raspilot.up.providers.OrientationProvider;
import org.raspilot.up.providers.ProviderStatus;
import org.raspilot.up.providers.ProvidersController;
import org.raspilot.up.providers.Rotation;
import org.raspilot.up.providers.Sensors;
import org.raspilot.up.providers.SharedSource;
import org.raspilot.up.providers.Side;

/** The providers that each airborne phone has (thesis 4.5.2), by its settings. */
final class BasicProviders {
    private static final long MAX_CALIBRATION_AGE_MS = 1000;

    private final LocationProvider location;
    final AltitudeProvider altitude;
    private final BatteryProvider battery;
    private final HeadingProvider heading;
    private final OrientationProvider orientation;

    BasicProviders(AirborneSettings settings, Sensors sensors) {
        SharedSource<Rotation> rotation = new SharedSource<>(sensors.rotation);
        location = new LocationProvider(sensors.location, settings.locationPeriodMs);
        altitude = new AltitudeProvider(sensors.pressure, settings.altitudePeriodMs);
        altitude.setReferenceHPa(settings.referencePressureHPa);
        battery = new BatteryProvider(sensors.battery);
        heading = new HeadingProvider(
                rotation.branch(), settings.mounting, settings.headingPeriodMs);
        orientation = settings.orientationTransport() == OrientationTransport.OFF ? null
                : new OrientationProvider(rotation.branch(), sensors.rotationRate,
                        settings.mounting, settings.orientationHz);
        setDeclinationDeg(settings.declinationDeg);
    }

    void register(ProvidersController providers) {
        providers.register(location);
        providers.register(altitude);
        providers.register(heading);
        providers.register(battery);
        if (orientation != null) {
            providers.register(orientation);
        }
    }

    void setMounting(Mounting mounting) {
        heading.setMounting(mounting);
        if (orientation != null) {
            orientation.setMounting(mounting);
        }
    }

    void setDeclinationDeg(double declinationDeg) {
        heading.setDeclinationDeg(declinationDeg);
        if (orientation != null) {
            orientation.setDeclinationDeg(declinationDeg);
        }
    }

    Mounting calibrate(Side nose) {
        ProviderStatus status = heading.status();
        if (heading.newest() == null || status.ageMs > MAX_CALIBRATION_AGE_MS) {
            throw new IllegalStateException(
                    "the phone's rotation is not known now (" + status.sensor + ")");
        }
        Mounting mounting = Mounting.level(heading.newest(), nose);
        setMounting(mounting);
        return mounting;
    }
}
