package org.raspilot.up.android;

import android.hardware.Sensor;
import java.util.concurrent.Executor;
import org.raspilot.up.providers.Pressure;

/** The air's pressure, by the phone's barometer. */
final class BarometerSource extends HardwareSource<Pressure> {
    BarometerSource(SensorAccess desk, Executor loop, SensorTexts texts, ProblemListener problems) {
        super(desk, Sensor.TYPE_PRESSURE, loop, texts, SensorProblem.BAROMETER, problems);
    }

    @Override
    Pressure read(float[] values, long timeMs) {
        return new Pressure(values[0]);
    }
}
