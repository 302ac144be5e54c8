package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertTrue;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.junit.Rule;
import org.junit.Test;
import org.raspilot.up.wire.ProxyRole;

/** Events in plain words, and active alarms. */
public final class EventMonitorTest {
    @Rule
    public final GroundBench bench = new GroundBench();

    private long beacon;

    private void frame(String data) {
        bench.loop.advance(100);
        bench.frame(++beacon, data);
    }

    private void frames(int count, String data) {
        for (int each = 0; each < count; each++) {
            frame(data);
        }
    }

    private List<String> newEvents(int from) {
        final List<String> all = bench.events();
        return all.subList(from, all.size());
    }

    private void assertAlarms(String wanted) {
        final List<String> active = new ArrayList<>();
        for (Alarm each : bench.ground.alarms().snapshot().active) {
            active.add(each.toString());
        }
        assertEquals(wanted.isEmpty() ? "[]" : "[" + wanted + "]", active.toString());
    }

    @Test
    public void eachChangeIsSaidOnceWithBothValues() {
        bench.open(ProxyRole.LISTEN);
        frame("{\"flight_mode\": \"RATE\", \"armed\": false, \"mode\": \"flight controller\"}");
        final int before = bench.events().size();
        for (int each = 0; each < 5; each++) {
            frame("{\"flight_mode\": \"FBW\", \"armed\": true, \"arduino\": {\"failsafe\": true},"
                    + " \"load\": {\"panic\": true, \"cpu\": 99.4, \"delay_ms\": 150},"
                    + " \"vetoes\": [\"b\", \"a\"]}");
        }
        assertEquals(Arrays.asList("flight_mode", "armed", "failsafe", "panic",
                "vetoes"), newEvents(before));
        final List<Event> events = bench.ground.events().snapshot().events;
        assertEquals(EventLevel.ALARM, events.get(before + 2).level);
        assertEquals("flight mode FBW (was RATE)", events.get(before).text);
        assertEquals("Raspberry Pi busy (99 %): telemetry every 150 ms",
                events.get(before + 3).text);
        assertTrue(events.get(before + 4).text.endsWith(": a; b"));
    }

    @Test
    public void whatFlapsIsSaidSeldom() {
        bench.open(ProxyRole.LISTEN);
        for (int each = 0; each < 600; each++) {
            frame("{\"armed\": " + (each % 2 == 0) + "}");
        }
        int said = 0;
        for (String each : bench.events()) {
            said += each.endsWith("armed") ? 1 : 0;
        }
        assertTrue("" + said, said >= 3 && said <= 7);
    }

    @Test
    public void whatIsNotKnownIsNoChange() {
        bench.open(ProxyRole.LISTEN);
        frame("{\"flight_mode\": \"FBW\"}");
        final int before = bench.events().size();
        frame("{\"flight_mode\": null}");
        frame("{\"flight_mode\": 5}");
        frame("{}");
        frame("{\"flight_mode\": \"FBW\"}");
        assertTrue(newEvents(before).isEmpty());
    }

    @Test
    public void theLinkIsToldToo() {
        bench.open(ProxyRole.LISTEN);
        assertEquals(Arrays.asList("link_open", "control_changed"), bench.events());
        bench.fly(1, 40);
        assertTrue(bench.events().contains("aircraft_online"));
        bench.peer().end("the network is gone");
        bench.loop.advance(30000);
        assertTrue(bench.events().contains("link_lost"));
    }

    @Test
    public void aPartThatNeverCameIsNotGone() {
        bench.open(ProxyRole.LISTEN);
        frame("{\"arduino\": {\"connected\": false}, \"android\": {\"connected\": false},"
                + " \"age_ms\": {\"flight\": null, \"battery\": null}}");
        assertTrue(bench.events().contains("board_awaited"));
        assertTrue(bench.events().contains("phone_awaited"));
        assertAlarms("WARNING board board_awaited");
        frame("{\"arduino\": {\"connected\": true}, \"android\": {\"connected\": true}}");
        frames(50, "{\"arduino\": {\"connected\": true}, \"android\": {\"connected\": true}}");
        assertTrue(bench.events().contains("board_connected"));
        frames(100, "{\"arduino\": {\"connected\": false}, \"android\": {\"connected\": false},"
                + " \"age_ms\": {\"flight\": 100, \"battery\": 100}}");
        assertTrue(bench.events().contains("board_lost"));
        assertTrue(bench.ground.alarms().snapshot().has("phone"));
    }

    @Test
    public void anAlarmBeginsAtOnceAndEndsTwoSecondsAfterItsCause() {
        bench.open(ProxyRole.LISTEN);
        frame("{\"arduino\": {\"failsafe\": true}}");
        assertTrue(bench.ground.alarms().snapshot().has("failsafe"));
        assertTrue(isLoud());
        final long version = bench.ground.alarms().snapshot().version;
        frames(19, "{\"arduino\": {\"failsafe\": false}}");
        assertTrue(bench.ground.alarms().snapshot().has("failsafe"));
        assertEquals(version, bench.ground.alarms().snapshot().version);
        frame("{\"arduino\": {\"failsafe\": false}}");
        assertFalse(bench.ground.alarms().snapshot().has("failsafe"));
    }

    @Test
    public void whatMustBeHeardIsLoud() {
        bench.open(ProxyRole.LISTEN);
        frame("{\"load\": {\"panic\": true}}");
        assertAlarms("");
        assertFalse(isLoud());
        frame("{\"android\": {\"batteryLevel\": 19}}");
        assertTrue(isLoud());
        frames(25, "{}");
        frame("{\"arduino\": {\"receiver_valid\": false}, \"armed\": false}");
        assertAlarms("WARNING receiver receiver_lost");
        assertFalse(isLoud());
        bench.loop.advance(901);
        assertAlarms("ALARM silent silent, WARNING receiver receiver_lost");
        assertTrue(isLoud());
    }

    @Test
    public void aBatteryThatIsLowIsNotChargedByANoise() {
        bench.open(ProxyRole.LISTEN);
        frame("{\"android\": {\"batteryLevel\": 19.9}}");
        frames(40, "{\"android\": {\"batteryLevel\": 22}}");
        assertTrue(bench.ground.alarms().snapshot().has("battery"));
        frame("{\"android\": {\"batteryLevel\": 9}}");
        assertAlarms("ALARM battery battery_empty");
        frames(40, "{\"android\": {\"batteryLevel\": 24}}");
        assertFalse(bench.ground.alarms().snapshot().has("battery"));
        assertTrue(bench.events().contains("battery_charged"));
    }

    @Test
    public void aSilenceBeforeTheFirstFrameOrAfterTheStopIsNoAlarm() {
        bench.start(GroundBench.settings(ProxyRole.LISTEN, false));
        bench.loop.advance(20000);
        assertAlarms("");
        bench.ground.reconnectNow();
        bench.accept(ProxyRole.LISTEN);
        bench.fly(1, 3);
        bench.peer().end("gone");
        bench.loop.advance(1);
        assertAlarms("ALARM silent no_link");
        bench.ground.stop();
        assertAlarms("");
        bench.ground.start();
        bench.loop.advance(5000);
        assertAlarms("");
    }

    @Test
    public void onlyTheNewestEventsAreKeptAndWordsAreHarmless() {
        final EventLog log = new EventLog();
        for (int each = 0; each < 500; each++) {
            log.add(each, EventLevel.INFO, "mode", "e" + each + "\u0007\u202e");
        }
        final List<Event> kept = log.snapshot().events;
        assertEquals(EventLog.MAX_ENTRIES, kept.size());
        assertEquals("e499", kept.get(kept.size() - 1).text);
        assertEquals(500, log.version());
    }

    @Test
    public void onChangedComesOnlyWhenSomethingDid() {
        bench.open(ProxyRole.LISTEN);
        frame("{\"armed\": false}");
        final int before = bench.changes;
        frame("{\"armed\": false}");
        assertEquals(before, bench.changes);
        frame("{\"armed\": true}");
        assertEquals(before + 1, bench.changes);
    }

    private boolean isLoud() {
        return bench.ground.alarms().snapshot().active.stream().anyMatch(each -> each.isLoud());
    }
}
