package org.raspilot.up.android;

import static org.junit.Assert.assertEquals;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.Executor;
import org.junit.Test;
import org.raspilot.up.providers.SensorListener;

public final class HandoverTest {
    private final List<Runnable> posted = new ArrayList<Runnable>();
    private final List<String> heard = new ArrayList<String>();
    private final Handover<String> handover = new Handover<String>(new Executor() {
        @Override
        public void execute(Runnable call) {
            posted.add(call);
        }
    });
    private final SensorListener<String> listener = new SensorListener<String>() {
        @Override
        public void onReading(String reading) {
            heard.add(reading);
        }
    };

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
        assertEquals(Collections.<String>emptyList(), heard);
    }

    @Test
    public void aNewListenerDoesNotHearTheOldOnesReading() {
        handover.to(listener);
        handover.give("old");
        handover.to(listener);
        run();
        assertEquals(Collections.<String>emptyList(), heard);
        handover.give("new");
        run();
        assertEquals(Collections.singletonList("new"), heard);
    }

    private void run() {
        List<Runnable> calls = new ArrayList<Runnable>(posted);
        posted.clear();
        for (Runnable call : calls) {
            call.run();
        }
    }
}
