package org.raspilot.up.android;

import static org.junit.Assert.assertEquals;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import org.junit.Test;
import org.raspilot.up.providers.SensorListener;

public final class HandoverTest {
    private final List<Runnable> posted = new ArrayList<>();
    private final List<String> heard = new ArrayList<>();
    private final Handover<String> handover = new Handover<>(call -> posted.add(call));
    private final SensorListener<String> listener = reading -> heard.add(reading);

    @Test
    public void aReadingThatWaitsIsReplacedByTheNext() {
        handover.to(listener);
        handover.give("old");
        handover.give("new");
        assertEquals(1, posted.size());
        run();
        handover.give("next");
        run();
        assertEquals(Arrays.asList("new", "next"), heard);
    }

    @Test
    public void afterTheEndNothingIsHeard() {
        handover.to(listener);
        handover.give("late");
        handover.to(null);
        run();
        assertEquals(Collections.emptyList(), heard);
    }

    @Test
    public void aNewListenerDoesNotHearTheOldOnesReading() {
        handover.to(listener);
        handover.give("old");
        handover.to(listener);
        run();
        assertEquals(Collections.emptyList(), heard);
        handover.give("new");
        run();
        assertEquals(Collections.singletonList("new"), heard);
    }

    private void run() {
        List<Runnable> calls = new ArrayList<>(posted);
        posted.clear();
        for (Runnable call : calls) {
            call.run();
        }
    }
}
