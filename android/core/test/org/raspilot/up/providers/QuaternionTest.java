package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;

import java.util.Random;
import org.junit.Test;

public final class QuaternionTest {
    private static final long SEED = 20160522;

    @Test
    public void aMatrixTurnsAsItsQuaternion() {
        Random random = new Random(SEED);
        for (int turn = 0; turn < 2000; turn++) {
            check(new Quaternion(random.nextGaussian(), random.nextGaussian(),
                    random.nextGaussian(), random.nextGaussian()).unit());
        }
    }

    @Test
    public void halfTurnsKeepTheirDigits() {
        check(new Quaternion(1, 0, 0, 0));
        check(new Quaternion(0, 1, 0, 0));
        check(new Quaternion(0, 0, 1, 0));
        check(new Quaternion(0, 0, 0, 1));
        check(new Quaternion(1e-4, 0.6, 0.8, 0).unit());
    }

    private static void check(Quaternion wanted) {
        double[] x = wanted.turn(1, 0, 0);
        double[] y = wanted.turn(0, 1, 0);
        double[] z = wanted.turn(0, 0, 1);
        float[] matrix = new float[9];
        for (int row = 0; row < 3; row++) {
            matrix[3 * row] = (float) x[row];
            matrix[3 * row + 1] = (float) y[row];
            matrix[3 * row + 2] = (float) z[row];
        }
        double[] turned = Quaternion.ofMatrix(matrix).turn(1, 2, 3);
        double[] right = wanted.turn(1, 2, 3);
        for (int axis = 0; axis < 3; axis++) {
            assertEquals("seed " + SEED, right[axis], turned[axis], 1e-5);
        }
    }
}
