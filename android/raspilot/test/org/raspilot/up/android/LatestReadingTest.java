package org.raspilot.up.android;

import static org.junit.Assert.assertEquals;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import org.junit.Test;
import org.raspilot.up.providers.SensorListener;

public final class LatestReadingTest {
    private final List<Runnable> posted = new ArrayList<>();
    private final List<String> heard = new ArrayList<>();
    private final LatestReading<String> handover = new LatestReading<>(call -> posted.add(call));
    private final SensorListener<String> listener = reading -> heard.add(reading);

    @Test
    public void aReadingThatWaitsIsReplacedByTheNext() {
        handover.setListener(listener);
        handover.put("old");
        handover.put("new");
        assertEquals(1, posted.size());
        run();
        handover.put("next");
        run();
        assertEquals(Arrays.asList("new", "next"), heard);
    }

    @Test
    public void afterTheEndNothingIsHeard() {
        handover.setListener(listener);
        handover.put("late");
        handover.setListener(null);
        run();
        assertEquals(Collections.emptyList(), heard);
    }

    @Test
    public void aNewListenerDoesNotHearTheOldOnesReading() {
        handover.setListener(listener);
        handover.put("old");
        handover.setListener(listener);
        run();
        assertEquals(Collections.emptyList(), heard);
        handover.put("new");
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
