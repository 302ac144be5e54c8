package org.raspilot.up.android;

import android.hardware.Sensor;
import android.hardware.SensorEvent;
import android.hardware.SensorEventListener;
import java.util.concurrent.Executor;
import java.util.concurrent.TimeUnit;
import org.raspilot.up.android.SensorProblem.SensorTexts;
import org.raspilot.up.providers.SensorListener;
import org.raspilot.up.providers.SensorSource;

/**
 * A source that is one of the phone's built-in sensors.
 *
 * @param <R> what one reading is
 */
final class HardwareSource<R> implements SensorSource<R>, SensorEventListener {
    /** Converts the values of an event, on the sensors' thread. */
    interface Reader<R> {
        /** Returns the reading, or null for none. */
        R read(float[] values, long timeMs);
    }

    private final SensorAccess access;
    private final Reader<R> reader;
    private final Sensor sensor;
    private final String absence;
    private final LatestReading<R> handover;
    private final ProblemListener problems;
    private final String refusal;
    private final BadReadings bad;

    /** Takes the type of {@link Sensor} and the reason to report if the phone has none. */
    HardwareSource(SensorAccess access, int type, Executor loop, SensorTexts texts,
            SensorProblem lack,
            ProblemListener problems, Reader<R> reader) {
        this.reader = reader;
        this.access = access;
        sensor = access.find(type);
        absence = texts.of(lack);
        refusal = texts.of(SensorProblem.REFUSED);
        handover = new LatestReading<>(loop);
        this.problems = problems;
        bad = new BadReadings(problems, refusal);
    }

    @Override
    public boolean isPresent() {
        return sensor != null;
    }

    @Override
    public String name() {
        if (sensor == null) {
            return absence;
        }
        // Some makers leave it out.
        String name = sensor.getName();
        return name == null ? "" : name;
    }

    @Override
    public void subscribe(long periodMs, SensorListener<R> listener) {
        if (sensor == null) {
            throw new IllegalStateException(absence);
        }
        access.unregister(this);
        handover.setListener(listener);
        if (!access.register(this, sensor, periodMs)) {
            problems.onProblem(refusal + ": " + sensor.getName());
        }
    }

    @Override
    public void unsubscribe() {
        access.unregister(this);
        handover.setListener(null);
    }

    @Override
    public void onSensorChanged(SensorEvent event) {
        try {
            R reading = reader.read(event.values, TimeUnit.NANOSECONDS.toMillis(event.timestamp));
            if (reading != null) {
                handover.put(reading);
            }
        } catch (RuntimeException wrong) {
            // Catches every exception: on the system's thread it would end the flight.
            bad.add(event.sensor == null ? "" : event.sensor.getName(), wrong);
        }
    }

    @Override
    public void onAccuracyChanged(Sensor changed, int accuracy) {
    }
}
