package org.raspilot.app;

import android.content.Context;
import android.view.View;
import android.widget.AdapterView;
import android.widget.Spinner;
import android.widget.TextView;
import org.raspilot.up.android.AndroidSources;
import org.raspilot.up.android.ProblemListener;
import org.raspilot.up.providers.Attitude;
import org.raspilot.up.providers.Mounting;
import org.raspilot.up.providers.Rotation;
import org.raspilot.up.providers.SensorListener;
import org.raspilot.up.providers.SensorSource;
import org.raspilot.up.providers.Side;

/**
 * The phone's mounting in the aeroplane: the current attitude by the phone, and the button that
 * makes it level. Works whether or not the service runs; a running service takes the new mounting
 * from the settings. On the main thread.
 */
final class MountingPanel implements SensorListener<Rotation> {
    private static final long PERIOD_MS = 100;

    private final Context context;
    private final AppSettings settings;
    private final SensorSource<Rotation> source;
    private final TextView roll;
    private final TextView pitch;
    private final TextView yaw;
    private final TextView said;
    private final Spinner nose;
    private Mounting mounting;
    private Rotation newest;

    MountingPanel(View root, AppSettings settings, ProblemListener problems) {
        context = root.getContext();
        this.settings = settings;
        source = AndroidSources.rotation(context, new AppSensorTexts(context), problems);
        roll = (TextView) root.findViewById(R.id.mounting_roll);
        pitch = (TextView) root.findViewById(R.id.mounting_pitch);
        yaw = (TextView) root.findViewById(R.id.mounting_yaw);
        said = (TextView) root.findViewById(R.id.mounting_said);
        nose = (Spinner) root.findViewById(R.id.mounting_nose);
        mounting = settings.mounting();
        TextView absent = (TextView) root.findViewById(R.id.mounting_absent);
        View level = root.findViewById(R.id.mounting_level);
        absent.setVisibility(source.isPresent() ? View.GONE : View.VISIBLE);
        absent.setText(source.name());
        level.setEnabled(source.isPresent());
        level.setOnClickListener(pressed -> calibrate());
        nose.setSelection(settings.nose().ordinal());
        nose.setOnItemSelectedListener(new NoseListener());
    }

    void begin() {
        if (source.isPresent()) {
            source.subscribe(PERIOD_MS, this);
        }
    }

    void end() {
        source.unsubscribe();
        newest = null;
    }

    @Override
    public void onReading(Rotation reading) {
        newest = reading;
        // The declination is the service's; here north is the compass's.
        Attitude attitude = mounting.attitude(reading, 0);
        roll.setText(context.getString(R.string.live_degrees, attitude.rollDeg));
        pitch.setText(context.getString(R.string.live_degrees, attitude.pitchDeg));
        yaw.setText(context.getString(R.string.live_yaw_degrees, attitude.yawDeg));
    }

    private void calibrate() {
        if (newest == null) {
            said.setText(R.string.mounting_no_reading);
            return;
        }
        try {
            mounting = Mounting.level(newest, Side.values()[nose.getSelectedItemPosition()]);
        } catch (IllegalArgumentException refusal) {
            said.setText(R.string.mounting_steep);
            return;
        }
        settings.setMounting(mounting);
        said.setText(R.string.mounting_done);
    }

    private final class NoseListener implements AdapterView.OnItemSelectedListener {
        @Override
        public void onItemSelected(AdapterView<?> parent, View item, int position, long id) {
            settings.setNose(Side.values()[position]);
        }

        @Override
        public void onNothingSelected(AdapterView<?> parent) {
        }
    }
}
