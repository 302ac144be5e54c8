package org.raspilot.up.providers;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;

import java.util.ArrayList;
import java.util.List;
import org.junit.Test;

/** One sensor for several readers: the fastest sets the rate, each subscribes independently. */
public final class SharedSourceTest {
    private final TestSource<String> sensor = new TestSource<>("sensor");
    private final SharedSource<String> shared = new SharedSource<>(sensor);
    private final SensorSource<String> slow = shared.branch();
    private final SensorSource<String> quick = shared.branch();
    private final List<String> heard = new ArrayList<>();

    @Test
    public void bothHearEachReadingAtTheQuickersPeriod() {
        slow.subscribe(200, listener("slow"));
        quick.subscribe(20, listener("quick"));
        sensor.give("a");
        assertEquals("[slow a, quick a]", heard.toString());
        assertEquals("[200, 20]", sensor.periodsMs.toString());
    }

    @Test
    public void theSensorIsLeftWithTheLastReader() {
        slow.subscribe(200, listener("slow"));
        quick.subscribe(20, listener("quick"));
        quick.unsubscribe();
        assertEquals("[200, 20, 200]", sensor.periodsMs.toString());
        sensor.give("a");
        assertEquals("[slow a]", heard.toString());
        slow.unsubscribe();
        slow.unsubscribe();
        assertEquals(null, sensor.listener);
    }

    @Test
    public void aSensorThatRefusedIsAskedAgain() {
        sensor.fault = new SecurityException("no permission");
        SecurityException error = assertThrows(SecurityException.class, () ->
                slow.subscribe(200, listener("slow")));
        slow.unsubscribe();
        sensor.fault = null;
        slow.subscribe(200, listener("slow"));
        sensor.give("a");
        assertEquals("[slow a]", heard.toString());
    }

    private SensorListener<String> listener(final String name) {
        return reading -> heard.add(name + " " + reading);
    }
}
