package org.raspilot.app.view;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import org.junit.Test;

public final class HeldPressTest {
    private final HeldPress press = new HeldPress();

    /** Checks each 20 ms until then; returns whether it fired. */
    private boolean look(long fromMs, long toMs) {
        boolean hasFired = false;
        for (long now = fromMs; now <= toMs; now += 20) {
            hasFired |= press.check(now);
        }
        return hasFired;
    }

    @Test
    public void aPressOfASecondFiresOnce() {
        press.press(0);
        assertFalse(look(0, 980));
        assertTrue(press.check(1000));
        assertFalse(look(1020, 5000));
        assertEquals(HeldPress.State.DONE, press.state());
    }

    @Test
    public void aPressThatIsLetGoEarlierDoesNothing() {
        press.press(0);
        look(0, 980);
        press.release();
        assertFalse(look(1000, 3000));
        assertEquals(0, press.progress(1000), 0);
    }

    @Test
    public void aPressThatWasCancelledStaysSoHoweverLongItIsHeld() {
        press.press(0);
        look(0, 500);
        press.cancel();
        assertFalse(look(520, 5000));
        press.press(5000);
        assertFalse(look(5000, 7000));
        press.release();
        press.press(8000);
        assertTrue(look(8000, 9000));
    }

    @Test
    public void aScreenThatHungFiresNothingWhenItWakes() {
        press.press(0);
        look(0, 500);
        assertFalse(press.check(1500));
        assertEquals(HeldPress.State.VOID, press.state());
    }

    @Test
    public void aClockThatGoesBackFiresNothing() {
        press.press(1000);
        assertFalse(press.check(900));
        assertFalse(look(920, 3000));
    }

    @Test
    public void theRingFillsWithTheTime() {
        press.press(0);
        assertEquals(0, press.progress(0), 0);
        assertEquals(0.5, press.progress(500), 1e-6);
        look(0, 1000);
        assertEquals(1, press.progress(1000), 0);
    }
}
