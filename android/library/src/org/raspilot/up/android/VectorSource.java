package org.raspilot.up.android;

import android.hardware.Sensor;
import android.os.Build;
import java.util.Arrays;
import java.util.concurrent.Executor;
import org.raspilot.up.providers.Rotation;

/**
 * How the phone lies and where north is, by its own fusion of its sensors. (The one that is called
 * the game's knows no north: its yaw would be sent as a heading.)
 */
final class VectorSource extends HardwareSource<Rotation> {
    private static final int AXES = 3;

    VectorSource(SensorDesk desk, Executor loop, SourceTexts texts, ProblemListener problems) {
        super(desk, Sensor.TYPE_ROTATION_VECTOR, loop, texts, Lack.ROTATION, problems);
    }

    @Override
    Rotation read(float[] values, long timeMs) {
        return rotation(values, timeMs, Build.VERSION.SDK_INT);
    }

    /** Returns the rotation of an event's values, or null where they are none. */
    static Rotation rotation(float[] values, long timeMs, int version) {
        // The fourth value is promised from Android 4.3 on; before, it may be there and zero.
        boolean hasFourth = version >= 18 && values.length > AXES;
        float[] known = hasFourth ? values : Arrays.copyOf(values, AXES);
        for (float value : known) {
            if (Float.isNaN(value) || Float.isInfinite(value)) {
                return null;
            }
        }
        return Rotation.ofVector(known, timeMs);
    }
}
