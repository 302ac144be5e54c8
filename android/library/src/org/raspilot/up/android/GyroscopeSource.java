package org.raspilot.up.android;

import android.hardware.Sensor;
import java.util.concurrent.Executor;
import org.raspilot.up.providers.RotationRate;

/** How quickly the phone turns, by its gyroscope. */
final class GyroscopeSource extends HardwareSource<RotationRate> {
    GyroscopeSource(SensorAccess desk, Executor loop, SensorTexts texts, ProblemListener problems) {
        super(desk, Sensor.TYPE_GYROSCOPE, loop, texts, SensorProblem.GYROSCOPE, problems);
    }

    @Override
    RotationRate read(float[] values, long timeMs) {
        return new RotationRate(values[0], values[1], values[2], timeMs);
    }
}
