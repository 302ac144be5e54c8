package org.raspilot.app;

import android.content.SharedPreferences;
import android.preference.PreferenceManager;
import org.raspilot.up.airborne.AirborneSettings.AirborneMode;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.airborne.AirborneStatus;
import org.raspilot.up.android.BaseUpService;
import org.raspilot.up.android.NotificationTexts;
import org.raspilot.up.android.SensorProblem.SensorTexts;

/** The airborne end, by the settings of this application. */
public final class RaspilotUpService extends BaseUpService {
    private static final String CHANNEL = "airborne";

    /** The system does not keep a strong reference to a listener. */
    private final SharedPreferences.OnSharedPreferenceChangeListener changes =
            (preferences, key) -> onSettingChanged(key);

    @Override
    public void onCreate() {
        super.onCreate();
        PreferenceManager.getDefaultSharedPreferences(this)
                .registerOnSharedPreferenceChangeListener(changes);
    }

    @Override
    public void onDestroy() {
        PreferenceManager.getDefaultSharedPreferences(this)
                .unregisterOnSharedPreferenceChangeListener(changes);
        super.onDestroy();
    }

    @Override
    protected AirborneSettings readSettings() {
        return new AppSettings(this).airborne();
    }

    @Override
    protected boolean isOnWifi() {
        AppSettings settings = new AppSettings(this);
        return settings.isOnWifi() && settings.mode() == AirborneMode.FLIGHT_CONTROLLER;
    }

    @Override
    protected SensorTexts sourceTexts() {
        return new AppSensorTexts(this);
    }

    @Override
    protected String noticeText(AirborneStatus status) {
        return RunPanel.linkText(this, status);
    }

    @Override
    protected void onEvent(String sentence) {
        RaspilotApplication.of(this).log(sentence);
    }

    @Override
    protected void onReferencePressure(double hPa) {
        new AppSettings(this).setReferencePressureHPa(hPa);
        RaspilotApplication.of(this).log(getString(R.string.altitude_zeroed, hPa));
    }

    /** Applies the settings that take effect immediately; others do at the next start. */
    private void onSettingChanged(String key) {
        if (getString(R.string.key_mounting).equals(key)) {
            setMounting(new AppSettings(this).mounting());
        } else if (getString(R.string.key_reference_pressure).equals(key)) {
            setReferencePressureHPa(new AppSettings(this).referencePressureHPa());
        }
    }

    @Override
    protected NotificationTexts noticeTexts() {
        return new NotificationTexts(R.drawable.ic_notification,
                android.R.drawable.ic_menu_close_clear_cancel, CHANNEL,
                getString(R.string.notice_channel), getString(R.string.notice_title),
                getString(R.string.stop), MainActivity.class);
    }
}
