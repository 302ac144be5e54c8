package org.raspilot.up.android;

import android.hardware.Sensor;
import android.os.Build;
import java.util.Arrays;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.providers.Rotation;

/** How the phone lies, by its own fusion of its sensors. */
final class VectorSource extends HardwareSource<Rotation> {
    /** Knows north: {@code Sensor.TYPE_ROTATION_VECTOR}. */
    static final int WITH_NORTH = Sensor.TYPE_ROTATION_VECTOR;
    /** Knows no north, no magnet disturbs it: {@code Sensor.TYPE_GAME_ROTATION_VECTOR} (API 18). */
    static final int WITHOUT_NORTH = 15;

    private static final int AXES = 3;

    VectorSource(SensorDesk desk, int type, Loop loop, SourceTexts texts,
            ProblemListener problems) {
        super(desk, type, loop, texts, Lack.ROTATION, problems);
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
