package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertTrue;

import java.util.Random;
import org.junit.Test;

/** The angles, above all where they have no single answer. */
public final class AttitudeTest {
    private static final long SEED = 42;

    @Test
    public void withTheNoseStraightUpOrDownRollIsToldAsYaw() {
        for (double pitch : new double[] {90, -90}) {
            for (double roll = -170; roll <= 180; roll += 35) {
                for (double yaw = 0; yaw < 360; yaw += 30) {
                    Attitude found = Attitude.of(new Attitude(roll, pitch, yaw).bodyToNed());
                    double expected = pitch > 0 ? yaw - roll : yaw + roll;
                    assertEquals(0, found.rollDeg, 0);
                    assertEquals(pitch, found.pitchDeg, 1e-5);
                    assertEquals(0, Math.IEEEremainder(found.yawDeg - expected, 360), 1e-4);
                }
            }
        }
    }

    @Test
    public void nearTheGimbalLockTheRotationIsStillTheSame() {
        Random random = new Random(SEED);
        for (int trial = 0; trial < 2000; trial++) {
            double off = Math.pow(10, -9 * random.nextDouble());
            Attitude given = new Attitude(360 * random.nextDouble() - 180,
                    (random.nextBoolean() ? 1 : -1) * (90 - off), 360 * random.nextDouble());
            Attitude found = Attitude.of(given.bodyToNed());
            Quaternion apart =
                    found.bodyToNed().conjugate().times(given.bodyToNed());
            double sine = Math.sqrt(
                    apart.x * apart.x + apart.y * apart.y + apart.z * apart.z);
            assertEquals("seed " + SEED + ", trial " + trial,
                    0, Math.toDegrees(2 * Math.asin(Math.min(1, sine))), 1e-4);
        }
    }

    @Test
    public void theYawIsNever360() {
        assertEquals(0, new Attitude(0, 0, 360).yawDeg, 0);
        assertEquals(0, new Attitude(0, 0, -1e-18).yawDeg, 0);
        assertEquals(359, new Attitude(0, 0, -1).yawDeg, 0);
        assertEquals(10, new Attitude(0, 0, 730).yawDeg, 0);
    }

    @Test
    public void whatIsNoRotationIsRefused() {
        double[] bad = {Double.NaN, Double.POSITIVE_INFINITY, 0};
        for (double w : bad) {
            try {
                new Rotation(w, 0, 0, 0, 0);
                throw new AssertionError("taken: " + w);
            } catch (IllegalArgumentException error) {
                assertTrue(error.getMessage().startsWith("no rotation"));
            }
        }
    }

    @Test
    public void anOldAndroidsVectorHasNoFourthValue() {
        Rotation three = Rotation.ofVector(new float[] {0, 0, 0.5f}, 7);
        assertEquals(Math.sqrt(0.75), three.deviceToWorld.w, 1e-9);
        assertEquals(7, three.timeMs);
        Rotation four = Rotation.ofVector(new float[] {0, 0, 0.5f, -0.8660254f, 0.1f}, 7);
        assertEquals(-0.8660254, four.deviceToWorld.w, 1e-6);
        assertEquals(1, Rotation.ofVector(new float[] {1.0001f, 0, 0}, 0).deviceToWorld.x, 0);
    }
}
