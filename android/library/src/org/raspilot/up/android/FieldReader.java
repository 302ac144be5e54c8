package org.raspilot.up.android;

import android.hardware.Sensor;
import android.hardware.SensorEvent;
import android.hardware.SensorManager;
import org.raspilot.up.providers.Quaternion;
import org.raspilot.up.providers.Rotation;

/**
 * Computes the orientation of the phone by gravity and the earth's magnetic field: for phones
 * without their own sensor fusion. In turns the aeroplane's own acceleration is taken for gravity:
 * good for a heading and on the ground, poor in flight.
 */
final class FieldReader implements HardwareSource.Reader<Rotation> {
    private static final double SMOOTH_MS = 200;

    private final LowPass gravity = new LowPass(SMOOTH_MS);
    private final LowPass field = new LowPass(SMOOTH_MS);
    private final float[] matrix = new float[9];

    @Override
    public Rotation read(SensorEvent event, long timeMs) {
        if (event.sensor.getType() == Sensor.TYPE_MAGNETIC_FIELD) {
            field.update(event.values, timeMs);
            return null;
        }
        gravity.update(event.values, timeMs);
        boolean isKnown = gravity.isKnown() && field.isKnown() && SensorManager.getRotationMatrix(
                matrix, null, gravity.values(), field.values());
        return isKnown ? new Rotation(Quaternion.ofMatrix(matrix), timeMs) : null;
    }
}
