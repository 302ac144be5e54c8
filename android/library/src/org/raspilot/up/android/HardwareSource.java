package org.raspilot.up.android;

import android.hardware.Sensor;
import android.hardware.SensorEvent;
import android.hardware.SensorEventListener;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Executor;
import java.util.concurrent.TimeUnit;
import org.raspilot.up.android.SensorProblem.SensorTexts;
import org.raspilot.up.providers.SensorListener;
import org.raspilot.up.providers.SensorSource;

/**
 * A source that reads one of the phone's built-in sensors, or several.
 *
 * @param <R> what one reading is
 */
final class HardwareSource<R> implements SensorSource<R>, SensorEventListener {
    /** Converts the values of an event, on the sensors' thread. */
    interface Reader<R> {
        /** Returns the reading, or null for none. */
        R read(SensorEvent event, long timeMs);
    }

    private final SensorAccess access;
    private final Reader<R> reader;
    private final List<Sensor> sensors = new ArrayList<>();
    private final String absence;
    private final LatestReading<R> handover;
    private final ProblemListener problems;
    private final String refusal;
    private final BadReadings bad;

    /** Takes the types of {@link Sensor} and the reason to report if the phone lacks one. */
    HardwareSource(SensorAccess access, Executor loop, SensorTexts texts, SensorProblem lack,
            ProblemListener problems, Reader<R> reader, int... types) {
        this.reader = reader;
        this.access = access;
        for (int type : types) {
            sensors.add(access.find(type));
        }
        absence = texts.of(lack);
        refusal = texts.of(SensorProblem.REFUSED);
        handover = new LatestReading<>(loop);
        this.problems = problems;
        bad = new BadReadings(problems, refusal);
    }

    @Override
    public boolean isPresent() {
        return !sensors.contains(null);
    }

    @Override
    public String name() {
        if (!isPresent()) {
            return absence;
        }
        StringBuilder names = new StringBuilder();
        for (Sensor sensor : sensors) {
            // Some makers leave it out.
            String name = sensor.getName() == null ? "" : sensor.getName();
            names.append(names.length() == 0 ? "" : ", ").append(name);
        }
        return names.toString();
    }

    @Override
    public void subscribe(long periodMs, SensorListener<R> listener) {
        if (!isPresent()) {
            throw new IllegalStateException(absence);
        }
        access.unregister(this);
        handover.setListener(listener);
        for (Sensor sensor : sensors) {
            if (!access.register(this, sensor, periodMs)) {
                problems.onProblem(refusal + ": " + sensor.getName());
            }
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
            R reading = reader.read(event, TimeUnit.NANOSECONDS.toMillis(event.timestamp));
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
