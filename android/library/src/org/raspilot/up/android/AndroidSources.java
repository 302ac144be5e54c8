package org.raspilot.up.android;

import android.content.Context;
import android.os.Handler;
import android.os.Looper;
import java.util.concurrent.Executor;
import org.raspilot.up.loop.Loop;
import org.raspilot.up.providers.BatteryLevel;
import org.raspilot.up.providers.Fix;
import org.raspilot.up.providers.Pressure;
import org.raspilot.up.providers.Rotation;
import org.raspilot.up.providers.RotationRate;
import org.raspilot.up.providers.SensorSource;
import org.raspilot.up.providers.Sensors;

/**
 * The phone's own sensors. The system calls on the thread that is handed in; readings are posted
 * to the loop.
 */
public final class AndroidSources implements Sensors {
    private final SensorSource<Fix> location;
    private final SensorSource<Rotation> rotation;
    private final SensorSource<RotationRate> rotationRate;
    private final SensorSource<Pressure> pressure;
    private final SensorSource<BatteryLevel> battery;

    /**
     * Finds the available sensors.
     *
     * @param context of the application or of anything in it
     * @param looper whose thread the system calls on
     * @param fixes receives each fix in addition to its provider
     */
    public AndroidSources(Context context, Looper looper, final Loop loop, SensorTexts texts,
            ProblemListener problems, FixListener fixes) {
        Context lasting = context.getApplicationContext();
        Executor posting = call -> loop.post(call);
        SensorAccess desk = new SensorAccess(lasting, looper);
        location = new LocationSource(lasting, looper, posting, texts, problems, fixes);
        rotation = rotation(desk, posting, texts, problems);
        rotationRate = new GyroscopeSource(desk, posting, texts, problems);
        pressure = new BarometerSource(desk, posting, texts, problems);
        battery = new BatterySource(lasting, new Handler(looper), posting, texts);
    }

    /** Returns the best source of a phone; its own fusion includes north and its gyroscope. */
    static SensorSource<Rotation> rotation(SensorAccess desk, Executor loop, SensorTexts texts,
            ProblemListener problems) {
        SensorSource<Rotation> vector = new VectorSource(desk, loop, texts, problems);
        return vector.isPresent() ? vector : new FieldSource(desk, loop, texts, problems);
    }

    @Override
    public SensorSource<Fix> location() {
        return location;
    }

    @Override
    public SensorSource<Rotation> rotation() {
        return rotation;
    }

    @Override
    public SensorSource<RotationRate> rotationRate() {
        return rotationRate;
    }

    @Override
    public SensorSource<Pressure> pressure() {
        return pressure;
    }

    @Override
    public SensorSource<BatteryLevel> battery() {
        return battery;
    }
}
