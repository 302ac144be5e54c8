package org.raspilot.app;

import android.app.Activity;
import org.raspilot.up.airborne.AirborneMode;
import org.raspilot.up.airborne.AirborneSettings;
import org.raspilot.up.airborne.AirborneStatus;
import org.raspilot.up.android.BaseUpService;
import org.raspilot.up.android.NoticeTexts;
import org.raspilot.up.android.SourceTexts;

/** The airborne end, by the settings of this application. */
public final class RaspilotUpService extends BaseUpService {
    private static final String CHANNEL = "airborne";

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
    protected SourceTexts sourceTexts() {
        return new AppSourceTexts(this);
    }

    @Override
    protected String noticeText(AirborneStatus status) {
        return status == null ? getString(R.string.link_begins) : status.linkText();
    }

    @Override
    protected void onEvent(String sentence) {
        RaspilotApplication.of(this).note(sentence);
    }

    @Override
    protected void onReferencePressure(double hPa) {
        new AppSettings(this).setReferencePressureHPa(hPa);
        RaspilotApplication.of(this).note(getString(R.string.altitude_zeroed, hPa));
    }

    @Override
    protected NoticeTexts noticeTexts() {
        return new NoticeTexts() {
            @Override
            public int icon() {
                return R.drawable.ic_notice;
            }

            @Override
            public int stopIcon() {
                return R.drawable.ic_stop;
            }

            @Override
            public String channel() {
                return CHANNEL;
            }

            @Override
            public String channelName() {
                return getString(R.string.notice_channel);
            }

            @Override
            public String title() {
                return getString(R.string.notice_title);
            }

            @Override
            public String stop() {
                return getString(R.string.stop);
            }

            @Override
            public Class<? extends Activity> screen() {
                return MainActivity.class;
            }
        };
    }
}
