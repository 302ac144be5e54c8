package org.raspilot.up.android;

import android.hardware.Sensor;
import android.os.Build;
import java.util.concurrent.Executor;
import org.raspilot.up.providers.Rotation;

/**
 * The phone's orientation relative to north, by its own sensor fusion. (The game rotation vector
 * has no north: its yaw would be sent as a heading.)
 */
final class VectorSource extends HardwareSource<Rotation> {
    VectorSource(SensorAccess desk, Executor loop, SensorTexts texts, ProblemListener problems) {
        super(desk, Sensor.TYPE_ROTATION_VECTOR, loop, texts, SensorProblem.ROTATION, problems);
    }

    @Override
    Rotation read(float[] values, long timeMs) {
        return RotationVector.read(values, timeMs, Build.VERSION.SDK_INT);
    }
}
