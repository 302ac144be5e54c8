package org.raspilot.up.android;

import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import org.junit.Test;

public final class FixFilterTest {
    private final FixFilter filter = new FixFilter();

    @Test
    public void aFixOfNowIsTaken() {
        filter.begin();
        assertTrue(filter.takes(0, 1000));
        assertTrue(filter.takes(FixFilter.MAX_AGE_MS, 2000));
    }

    @Test
    public void anOldFixIsNotTaken() {
        filter.begin();
        assertFalse(filter.takes(FixFilter.MAX_AGE_MS + 1, 1000));
    }

    @Test
    public void theFixThatTheSystemKnewBeforeIsNotTaken() {
        filter.begin(5000);
        assertFalse(filter.takes(0, 5000));
        assertTrue(filter.takes(0, 6000));
    }

    @Test
    public void theReceiversTimeMayGoBack() {
        filter.begin(5000);
        assertTrue(filter.takes(0, 4000));
    }

    @Test
    public void aStartWithoutAKnownFixForgetsTheLastOne() {
        filter.begin(5000);
        filter.begin();
        assertTrue(filter.takes(0, 5000));
    }
}
