package org.raspilot.up.wire;

import java.nio.ByteBuffer;

/**
 * One frame of the Orientation Forward Protocol: attitude in deg and rates in deg/s.
 *
 * <p>Positive roll is right wing down, pitch nose up, yaw clockwise from above. Source:
 * docs/protocols.md 3.
 */
public final class OrientationFrame {
    public static final int SIZE = 24;
    public static final float MAX_ANGLE_DEG = 360f;
    public static final float MAX_RATE_DEG_S = 4000f;

    public final float rollDeg;
    public final float pitchDeg;
    public final float yawDeg;
    public final float rollRateDegS;
    public final float pitchRateDegS;
    public final float yawRateDegS;

    /** Creates a frame of any values; see {@link #isInRange}. */
    public OrientationFrame(float rollDeg, float pitchDeg, float yawDeg, float rollRateDegS,
            float pitchRateDegS, float yawRateDegS) {
        this.rollDeg = rollDeg;
        this.pitchDeg = pitchDeg;
        this.yawDeg = yawDeg;
        this.rollRateDegS = rollRateDegS;
        this.pitchRateDegS = pitchRateDegS;
        this.yawRateDegS = yawRateDegS;
    }

    /** Returns whether a receiver accepts it: all six finite and within their limits. */
    public boolean isInRange() {
        return isWithin(rollDeg, MAX_ANGLE_DEG)
                && isWithin(pitchDeg, MAX_ANGLE_DEG)
                && isWithin(yawDeg, MAX_ANGLE_DEG)
                && isWithin(rollRateDegS, MAX_RATE_DEG_S)
                && isWithin(pitchRateDegS, MAX_RATE_DEG_S)
                && isWithin(yawRateDegS, MAX_RATE_DEG_S);
    }

    public byte[] toBytes() {
        return ByteBuffer.allocate(SIZE)
                .putFloat(rollDeg).putFloat(pitchDeg).putFloat(yawDeg)
                .putFloat(rollRateDegS).putFloat(pitchRateDegS).putFloat(yawRateDegS)
                .array();
    }

    private static boolean isWithin(float value, float limit) {
        // NaN compares as false.
        return -limit <= value && value <= limit;
    }
}
