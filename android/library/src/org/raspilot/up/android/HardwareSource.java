package org.raspilot.up.android;

import android.hardware.Sensor;
import android.hardware.SensorEvent;
import android.hardware.SensorEventListener;
import java.util.concurrent.Executor;
import java.util.concurrent.TimeUnit;
import org.raspilot.up.providers.SensorListener;
import org.raspilot.up.providers.SensorSource;

/**
 * A source that is one of the phone's built-in sensors.
 *
 * @param <R> what one reading is
 */
abstract class HardwareSource<R> implements SensorSource<R>, SensorEventListener {
    private final SensorAccess desk;
    private final Sensor sensor;
    private final String absence;
    private final LatestReading<R> handover;
    private final ProblemListener problems;
    private final String refusal;
    private final BadReadings bad;

    /** Takes the type of {@link Sensor} and the reason to report if the phone has none. */
    HardwareSource(SensorAccess desk, int type, Executor loop, SensorTexts texts,
            SensorProblem lack,
            ProblemListener problems) {
        this.desk = desk;
        sensor = desk.find(type);
        absence = texts.of(lack);
        refusal = texts.of(SensorProblem.REFUSED);
        handover = new LatestReading<>(loop);
        this.problems = problems;
        bad = new BadReadings(problems, refusal);
    }

    /** Returns the reading of an event, or null for none; on the sensors' thread. */
    abstract R read(float[] values, long timeMs);

    @Override
    public final boolean isPresent() {
        return sensor != null;
    }

    @Override
    public final String name() {
        if (sensor == null) {
            return absence;
        }
        // Some makers leave it out.
        String name = sensor.getName();
        return name == null ? "" : name;
    }

    @Override
    public final void subscribe(long periodMs, SensorListener<R> listener) {
        if (sensor == null) {
            throw new IllegalStateException(absence);
        }
        desk.unregister(this);
        handover.setListener(listener);
        if (!desk.register(this, sensor, periodMs)) {
            problems.onProblem(refusal + ": " + sensor.getName());
        }
    }

    @Override
    public final void unsubscribe() {
        desk.unregister(this);
        handover.setListener(null);
    }

    @Override
    public final void onSensorChanged(SensorEvent event) {
        try {
            R reading = read(event.values, TimeUnit.NANOSECONDS.toMillis(event.timestamp));
            if (reading != null) {
                handover.put(reading);
            }
        } catch (RuntimeException wrong) {
            // Catches every exception: on the system's thread it would end the flight.
            bad.add(event.sensor == null ? "" : event.sensor.getName(), wrong);
        }
    }

    @Override
    public final void onAccuracyChanged(Sensor changed, int accuracy) {
    }
}
