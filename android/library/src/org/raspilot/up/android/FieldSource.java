package org.raspilot.up.android;

import android.hardware.Sensor;
import android.hardware.SensorEvent;
import android.hardware.SensorEventListener;
import android.hardware.SensorManager;
import java.util.concurrent.Executor;
import java.util.concurrent.TimeUnit;
import org.raspilot.up.android.SensorProblem.SensorTexts;
import org.raspilot.up.providers.Quaternion;
import org.raspilot.up.providers.Rotation;
import org.raspilot.up.providers.SensorListener;
import org.raspilot.up.providers.SensorSource;

/**
 * The orientation of the phone by gravity and the earth's magnetic field: for phones without their
 * own sensor fusion. In turns the aeroplane's own acceleration is taken for gravity: good for a
 * heading and on the ground, poor in flight.
 */
final class FieldSource implements SensorSource<Rotation>, SensorEventListener {
    private static final double SMOOTH_MS = 200;

    private final SensorAccess desk;
    private final Sensor accelerometer;
    private final Sensor magnetometer;
    private final String absence;
    private final String refusal;
    private final BadReadings bad;
    private final LatestReading<Rotation> handover;
    private final ProblemListener problems;
    private final LowPass gravity = new LowPass(SMOOTH_MS);
    private final LowPass field = new LowPass(SMOOTH_MS);
    private final float[] matrix = new float[9];

    FieldSource(SensorAccess desk, Executor loop, SensorTexts texts, ProblemListener problems) {
        this.desk = desk;
        accelerometer = desk.find(Sensor.TYPE_ACCELEROMETER);
        magnetometer = desk.find(Sensor.TYPE_MAGNETIC_FIELD);
        absence = texts.of(SensorProblem.ROTATION);
        refusal = texts.of(SensorProblem.REFUSED);
        handover = new LatestReading<>(loop);
        this.problems = problems;
        bad = new BadReadings(problems, refusal);
    }

    @Override
    public boolean isPresent() {
        return accelerometer != null && magnetometer != null;
    }

    @Override
    public String name() {
        return isPresent() ? accelerometer.getName() + ", " + magnetometer.getName() : absence;
    }

    @Override
    public void subscribe(long periodMs, SensorListener<Rotation> listener) {
        if (!isPresent()) {
            throw new IllegalStateException(absence);
        }
        desk.unregister(this);
        handover.setListener(listener);
        listen(accelerometer, periodMs);
        listen(magnetometer, periodMs);
    }

    @Override
    public void unsubscribe() {
        desk.unregister(this);
        handover.setListener(null);
    }

    @Override
    public void onSensorChanged(SensorEvent event) {
        try {
            update(event);
        } catch (RuntimeException wrong) {
            // Catches every exception: on the system's thread it would end the flight.
            bad.add(event.sensor.getName(), wrong);
        }
    }

    private void update(SensorEvent event) {
        long timeMs = TimeUnit.NANOSECONDS.toMillis(event.timestamp);
        if (event.sensor.getType() == Sensor.TYPE_MAGNETIC_FIELD) {
            field.update(event.values, timeMs);
            return;
        }
        gravity.update(event.values, timeMs);
        boolean isKnown = gravity.isKnown() && field.isKnown() && SensorManager.getRotationMatrix(
                matrix, null, gravity.values(), field.values());
        if (isKnown) {
            handover.put(new Rotation(Quaternion.ofMatrix(matrix), timeMs));
        }
    }

    @Override
    public void onAccuracyChanged(Sensor changed, int accuracy) {
    }

    private void listen(Sensor sensor, long periodMs) {
        if (!desk.register(this, sensor, periodMs)) {
            problems.onProblem(refusal + ": " + sensor.getName());
        }
    }
}
