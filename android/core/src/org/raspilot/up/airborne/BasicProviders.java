package org.raspilot.up.airborne;

import org.raspilot.up.airborne.AirborneSettings.OrientationTransport;
import org.raspilot.up.providers.AltitudeProvider;
import org.raspilot.up.providers.BatteryProvider;
import org.raspilot.up.providers.HeadingProvider;
import org.raspilot.up.providers.LocationProvider;
import org.raspilot.up.providers.Mounting;
import org.raspilot.up.providers.OrientationProvider;
import org.raspilot.up.providers.ProvidersController;
import org.raspilot.up.providers.Rotation;
import org.raspilot.up.providers.Sensors;
import org.raspilot.up.providers.SharedSource;

/** The providers that each airborne phone has (thesis 4.5.2), by its settings. */
final class BasicProviders {
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
}
