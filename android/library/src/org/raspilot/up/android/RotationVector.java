package org.raspilot.up.android;

import java.util.Arrays;
import org.raspilot.up.providers.Rotation;

/** The values of the system's rotation vector; on some phones the first event has four zeros. */
final class RotationVector {
    private static final int AXES = 3;

    /** From this version on the fourth value is promised; before, it may be there and zero. */
    private static final int FOURTH = 18;

    /** A rotation's is 1; rounding and poor fusions are far from this. */
    private static final double MIN_LENGTH = 0.5;

    private RotationVector() {
    }

    /** Returns the rotation of an event's values in a version of Android; null: invalid. */
    static Rotation read(float[] values, long timeMs, int version) {
        if (values.length < AXES) {
            return null;
        }
        boolean hasFourth = version >= FOURTH && values.length > AXES;
        float[] known = Arrays.copyOf(values, hasFourth ? AXES + 1 : AXES);
        double square = 0;
        for (float value : known) {
            square += (double) value * value;
        }
        boolean isFinite = !Double.isNaN(square) && !Double.isInfinite(square);
        // Without the fourth value three zeros mean: flat, with the top to the north.
        boolean isLong = !hasFourth || square >= MIN_LENGTH * MIN_LENGTH;
        return isFinite && isLong ? Rotation.ofVector(known, timeMs) : null;
    }
}
