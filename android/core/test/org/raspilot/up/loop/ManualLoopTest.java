package org.raspilot.up.loop;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.junit.Test;

public final class ManualLoopTest {
    private final Faults faults = new Faults();
    private final ManualLoop loop = new ManualLoop(null, faults);
    private final List<String> done = new ArrayList<>();

    @Test
    public void timersRunInTheOrderOfTheirTimesEachAtItsOwn() {
        loop.schedule(30, note("c"));
        loop.schedule(10, note("a"));
        loop.schedule(20, note("b"));
        loop.schedule(10, note("a too"));
        loop.advance(25);
        assertEquals(Arrays.asList("a at 10", "a too at 10", "b at 20"), done);
        assertEquals(25, loop.nowMs());
        assertEquals(1, loop.pendingTimers());
    }

    @Test
    public void timersAndCallsOfACallRunInTheSameStep() {
        loop.schedule(10, () -> {
            loop.schedule(5, note("later"));
            loop.schedule(-5, note("now"));
            loop.post(note("posted"));
        });
        loop.advance(20);
        assertEquals(Arrays.asList("posted at 10", "now at 10", "later at 15"), done);
    }

    @Test
    public void timeDoesNotGoBack() {
        assertThrows(IllegalArgumentException.class, () -> loop.advance(-1));
    }

    @Test
    public void aDelayOfCenturiesIsNotThePast() {
        loop.advance(1000);
        loop.schedule(Long.MAX_VALUE, note("never"));
        loop.advance(1000000000000L);
        assertTrue(done.isEmpty());
    }

    private Runnable note(final String name) {
        return () -> done.add(name + " at " + loop.nowMs());
    }
}
