package org.raspilot.app;

import android.content.Context;
import org.raspilot.up.android.Lack;
import org.raspilot.up.android.SourceTexts;

/** The texts for missing parts of a phone, from the resources. */
final class AppSourceTexts implements SourceTexts {
    private final Context context;

    AppSourceTexts(Context context) {
        this.context = context.getApplicationContext();
    }

    @Override
    public String of(Lack lack) {
        return context.getString(text(lack));
    }

    private static int text(Lack lack) {
        switch (lack) {
            case LOCATION_PERMISSION:
                return R.string.lack_location_permission;
            case LOCATION:
                return R.string.lack_location;
            case LOCATION_OFF:
                return R.string.lack_location_off;
            case ROTATION:
                return R.string.lack_rotation;
            case GYROSCOPE:
                return R.string.lack_gyroscope;
            case BAROMETER:
                return R.string.lack_barometer;
            case BATTERY:
                return R.string.lack_battery;
            case SPEECH:
                return R.string.lack_speech;
            default:
                return R.string.lack_refused;
        }
    }
}
