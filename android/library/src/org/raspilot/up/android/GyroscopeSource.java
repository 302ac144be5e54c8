package org.raspilot.up.android;

import android.hardware.Sensor;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.providers.RotationRate;

/** How quickly the phone turns, by its gyroscope. */
final class GyroscopeSource extends HardwareSource<RotationRate> {
    GyroscopeSource(SensorDesk desk, Loop loop, SourceTexts texts, ProblemListener problems) {
        super(desk, Sensor.TYPE_GYROSCOPE, loop, texts, Lack.GYROSCOPE, problems);
    }

    @Override
    RotationRate read(float[] values, long timeMs) {
        return new RotationRate(values[0], values[1], values[2], timeMs);
    }
}
