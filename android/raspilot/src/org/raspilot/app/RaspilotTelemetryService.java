package org.raspilot.app;

import org.raspilot.up.android.TelemetryService;
import org.raspilot.up.ground.GroundSettings;

/** The ground's end, by the settings of this application. */
public final class RaspilotTelemetryService extends TelemetryService {
    @Override
    protected GroundSettings readSettings() {
        return new AppSettings(this).ground();
    }

    @Override
    protected boolean isOnWifi() {
        AppSettings settings = new AppSettings(this);
        return settings.isOnWifi() && settings.ground().isDirect;
    }
}
