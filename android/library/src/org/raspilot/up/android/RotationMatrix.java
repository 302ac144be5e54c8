package org.raspilot.up.android;

import org.raspilot.up.providers.Quaternion;

/** Rotations as matrices of nine numbers, row by row, as Android's SensorManager writes them. */
final class RotationMatrix {
    private RotationMatrix() {
    }

    /**
     * Returns the quaternion of a rotation matrix; divides by the greatest of the four parts, so
     * that no rotation loses its digits (Shepperd 1978).
     */
    static Quaternion quaternion(float[] m) {
        double trace = m[0] + m[4] + m[8];
        if (trace >= m[0] && trace >= m[4] && trace >= m[8]) {
            double w = 1 + trace;
            return new Quaternion(w, m[7] - m[5], m[2] - m[6], m[3] - m[1]).unit();
        }
        if (m[0] >= m[4] && m[0] >= m[8]) {
            double x = 1 + m[0] - m[4] - m[8];
            return new Quaternion(m[7] - m[5], x, m[3] + m[1], m[2] + m[6]).unit();
        }
        if (m[4] >= m[8]) {
            double y = 1 - m[0] + m[4] - m[8];
            return new Quaternion(m[2] - m[6], m[3] + m[1], y, m[7] + m[5]).unit();
        }
        double z = 1 - m[0] - m[4] + m[8];
        return new Quaternion(m[3] - m[1], m[2] + m[6], m[7] + m[5], z).unit();
    }
}
