package org.raspilot.up.android;

import android.content.Context;
import android.hardware.Sensor;
import android.os.Build;
import android.os.Handler;
import android.os.Looper;
import java.util.concurrent.Executor;
import org.raspilot.up.android.SensorProblem.SensorTexts;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.providers.AltitudeProvider.Pressure;
import org.raspilot.up.providers.Rotation;
import org.raspilot.up.providers.RotationRate;
import org.raspilot.up.providers.SensorSource;
import org.raspilot.up.providers.Sensors;

/**
 * The phone's own sensors. The system calls on the thread that is handed in; readings are posted
 * to the loop.
 */
public final class AndroidSources {
    private AndroidSources() {
    }

    /**
     * Finds the available sensors; the system calls on the looper's thread, {@code declination}
     * receives each fix, too.
     */
    static Sensors find(Context context, Looper looper, Loop loop, SensorTexts texts,
            ProblemListener problems, Declination declination) {
        Context lasting = context.getApplicationContext();
        Executor posting = call -> loop.post(call);
        SensorAccess access = new SensorAccess(lasting, looper);
        return new Sensors(
                new LocationSource(lasting, looper, posting, texts, problems, declination),
                rotation(access, posting, texts, problems),
                new HardwareSource<>(access, posting, texts, SensorProblem.GYROSCOPE, problems,
                        (event, timeMs) -> new RotationRate(event.values[0], event.values[1],
                                event.values[2], timeMs),
                        Sensor.TYPE_GYROSCOPE),
                new HardwareSource<>(access, posting, texts, SensorProblem.BAROMETER, problems,
                        (event, timeMs) -> new Pressure(event.values[0]), Sensor.TYPE_PRESSURE),
                new BatterySource(lasting, new Handler(looper), posting, texts));
    }

    /** Returns the phone's orientation for a screen, whether or not it is sent; on the main thread. */
    public static SensorSource<Rotation> rotation(Context context, SensorTexts texts,
            ProblemListener problems) {
        final Handler main = new Handler(Looper.getMainLooper());
        return rotation(new SensorAccess(context.getApplicationContext(), Looper.getMainLooper()),
                call -> main.post(call), texts, problems);
    }

    /** Returns the best source of a phone; its own fusion includes north and its gyroscope. */
    static SensorSource<Rotation> rotation(SensorAccess access, Executor loop, SensorTexts texts,
            ProblemListener problems) {
        // The game rotation vector has no north: its yaw would be sent as a heading.
        SensorSource<Rotation> vector = new HardwareSource<>(access, loop, texts,
                SensorProblem.ROTATION, problems, (event, timeMs) ->
                        RotationVector.read(event.values, timeMs, Build.VERSION.SDK_INT),
                Sensor.TYPE_ROTATION_VECTOR);
        return vector.isPresent() ? vector : new HardwareSource<>(access, loop, texts,
                SensorProblem.ROTATION, problems, new FieldReader(), Sensor.TYPE_ACCELEROMETER,
                Sensor.TYPE_MAGNETIC_FIELD);
    }
}
