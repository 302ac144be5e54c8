package org.raspilot.up.android;

import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import org.junit.Test;

public final class FixChoiceTest {
    private final FixChoice choice = new FixChoice();

    @Test
    public void theNetworkIsTakenUntilTheGpsSpeaks() {
        assertTrue(choice.takes(false, 0));
        assertTrue(choice.takes(true, 1000));
        assertFalse(choice.takes(false, 2000));
    }

    @Test
    public void theNetworkIsTakenAgainWhenTheGpsIsSilent() {
        assertTrue(choice.takes(true, 1000));
        assertFalse(choice.takes(false, 1000 + FixChoice.GPS_SILENT_MS));
        assertTrue(choice.takes(false, 1001 + FixChoice.GPS_SILENT_MS));
        assertTrue(choice.takes(true, 12000));
        assertFalse(choice.takes(false, 12001));
    }

    @Test
    public void aNewStartForgetsTheGps() {
        choice.takes(true, 1000);
        choice.forget();
        assertTrue(choice.takes(false, 1001));
    }
}
