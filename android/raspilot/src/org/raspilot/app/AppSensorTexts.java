package org.raspilot.app;

import android.content.Context;
import org.raspilot.up.android.SensorProblem.SensorTexts;
import org.raspilot.up.android.SensorProblem;

/** The texts for missing parts of a phone, from the resources. */
final class AppSensorTexts implements SensorTexts {
    private final Context context;

    AppSensorTexts(Context context) {
        this.context = context.getApplicationContext();
    }

    @Override
    public String of(SensorProblem lack) {
        return context.getString(text(lack));
    }

    private static int text(SensorProblem lack) {
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
