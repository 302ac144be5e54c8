package org.raspilot.up.android;

import static org.junit.Assert.assertEquals;

import org.junit.Test;

public final class SleepCountTest {
    private final SleepCount sleep = new SleepCount();

    @Test
    public void sleepIsTheDifference() {
        assertEquals(0, sleep.totalMs(5000, 5000));
        assertEquals(600000, sleep.totalMs(606000, 6000));
        assertEquals(600000, sleep.totalMs(607000, 7000));
    }

    @Test
    public void whatPassesBetweenTheTwoReadingsIsNoSleep() {
        assertEquals(1000, sleep.totalMs(6000, 5000));
        assertEquals(1000, sleep.totalMs(6000, 5050));
        assertEquals(1000, sleep.totalMs(7050, 6050));
    }
}
