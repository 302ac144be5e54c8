package org.raspilot.app.view;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.util.Random;
import org.junit.Test;

public final class TapeGeometryTest {
    private static TapeGeometry of(float step, float value) {
        TapeGeometry geometry = new TapeGeometry(step);
        geometry.resize(200, 10);
        geometry.show(value);
        return geometry;
    }

    @Test
    public void aWholeMarkStandsAtThePointer() {
        TapeGeometry geometry = of(5, 40);
        int middle = (geometry.count() - 1) / 2;
        assertEquals(40, geometry.value(middle), 0);
        assertEquals(0, geometry.y(middle), 0);
    }

    @Test
    public void greaterValuesStandAboveAndToTheRight() {
        TapeGeometry geometry = of(5, 40);
        int middle = (geometry.count() - 1) / 2;
        assertEquals(-10, geometry.y(middle + 1), 0);
        assertEquals(10, geometry.x(middle + 1), 0);
        assertEquals(45, geometry.value(middle + 1), 0);
    }

    @Test
    public void aValueThatGrowsMovesTheMarksDown() {
        assertEquals(2, of(5, 41).y(0) - of(5, 40).y(0), 1e-4);
    }

    @Test
    public void theMarksCoverTheScaleForAnyValue() {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        for (int round = 0; round < 500; round++) {
            float value = (random.nextFloat() - 0.5f) * 60000;
            TapeGeometry geometry = of(1 + random.nextInt(20), value);
            String told = "seed " + seed + ", value " + value;
            assertTrue(told, geometry.y(0) >= 100);
            assertTrue(told, geometry.y(geometry.count() - 1) <= -100);
            float atPointer = geometry.value(0) + geometry.y(0) / 10
                    * (geometry.value(1) - geometry.value(0));
            assertEquals(told, value, atPointer, Math.abs(value) * 1e-4 + 0.05);
        }
    }

    @Test
    public void eachFifthMarkCountsFromZeroBelowZeroToo() {
        TapeGeometry geometry = of(1, -3);
        for (int place = 0; place < geometry.count(); place++) {
            assertEquals(Math.round(geometry.value(place)) % 5 == 0, geometry.isEach(place, 5));
        }
    }

    @Test
    public void theFirstMarkStaysUntilAWholeStepHasPassed() {
        assertEquals(of(5, 40).firstMark(), of(5, 42).firstMark());
        assertFalse(of(5, 40).firstMark() == of(5, 43).firstMark());
    }

    @Test
    public void aDistanceIsMeasuredAlongTheScale() {
        assertEquals(20, of(5, 40).distance(50, 40), 0);
        assertEquals(-20, of(5, 40).distance(30, 40), 0);
    }
}
