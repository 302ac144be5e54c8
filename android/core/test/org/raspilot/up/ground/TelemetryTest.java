package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertThrows;
import static org.junit.Assert.assertTrue;

import java.math.BigInteger;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import org.junit.Test;
import org.raspilot.up.ground.TelemetryText.TelemetryRow;

/** Values read from a frame with any content, and their age. */
public final class TelemetryTest {
    private static final String FRAME = "{\"orientation\": {\"roll\": 3.5, \"pitch\": null},"
            + " \"altitude\": 12, \"armed\": false, \"flight_mode\": \"FBW\","
            + " \"android\": {\"batteryLevel\": 70}, \"location\": {\"latitude\": 49.1},"
            + " \"vetoes\": [\"no receiver\", 3, null, \"a\\nb\"],"
            + " \"age_ms\": {\"orientation\": 100, \"location\": 1200, \"battery\": 60000,"
            + " \"flight\": 50, \"altitude\": null}}";

    private final Telemetry frame =
            Telemetry.of(GroundBench.json(FRAME), 7L, 10000, 200);

    @Test
    public void valuesAreReadByPathAndType() {
        assertEquals(3.5, frame.number("orientation.roll"), 0);
        assertEquals(12, frame.number("altitude"), 0);
        assertEquals(false, frame.flag("armed"));
        assertEquals("FBW", frame.text("flight_mode"));
        assertEquals(Arrays.asList("no receiver", "a b"), frame.texts("vetoes"));
        assertEquals(4, frame.list("vetoes").size());
        assertEquals(Long.valueOf(7), frame.beacon);
        assertEquals(1, frame.object("location").size());
    }

    @Test
    public void aFieldOfAWrongTypeIsAFieldNotKnown() {
        assertNull(frame.number("orientation"));
        assertNull(frame.number("orientation.pitch"));
        assertNull(frame.number("orientation.roll.more"));
        assertNull(frame.number("armed"));
        assertNull(frame.number("flight_mode"));
        assertNull(frame.flag("altitude"));
        assertNull(frame.text("altitude"));
        assertNull(frame.texts("armed"));
        assertNull(frame.object("vetoes"));
        assertNull(frame.number(""));
        assertNull(frame.number("."));
        assertNull(frame.number("orientation."));
        final Telemetry great = GroundBench.telemetry("{\"a\": 1e13, \"b\": -1e13,"
                + " \"c\": 99999999999999999999, \"age_ms\": 5}", 0);
        assertNull(great.number("a"));
        assertNull(great.number("b"));
        assertNull(great.number("c"));
    }

    @Test
    public void textsAreCutAndHarmless() {
        final Telemetry hostile = GroundBench.telemetry("{\"mode\": \"" + "x".concat(
                new String(new char[500]).replace("\0", "y")) + "\","
                + " \"t\": \"a\\u001b[31mb\\u202ec\\u0000\\u200bd\"}", 0);
        assertEquals(40, hostile.text("mode").length());
        assertTrue(hostile.text("mode").endsWith("\u2026"));
        assertEquals("a[31mbcd", hostile.text("t"));
    }

    @Test
    public void ageIsThatOnTheAircraftOnTheWayAndSince() {
        assertEquals(Long.valueOf(200), frame.age.frameMs(10000));
        assertEquals(Long.valueOf(650), frame.age.frameMs(10450));
        assertEquals(Long.valueOf(100 + 200 + 450), frame.age.readingMs("orientation", 10450));
        assertNull(frame.age.readingMs("altitude", 10450));
        assertNull(frame.age.readingMs("rx", 10450));
    }

    @Test
    public void aValueIsLiveUntilItsOwnAgeSaysOtherwise() {
        assertEquals(Freshness.LIVE, frame.freshness("orientation.roll", 10000));
        assertEquals(Freshness.LIVE, frame.freshness("orientation.roll", 10600));
        assertEquals(Freshness.STALE, frame.freshness("orientation.roll", 10601));
        assertEquals(Freshness.LIVE, frame.freshness("location.latitude", 10500));
        assertEquals(Freshness.STALE, frame.freshness("location.latitude", 10501));
        assertEquals(Freshness.LIVE, frame.freshness("android.batteryLevel", 10700));
        assertEquals(Freshness.LIVE, frame.freshness("altitude", 10700));
        assertEquals(Freshness.NONE, frame.freshness("orientation.pitch", 10000));
        assertEquals(Freshness.NONE, frame.freshness("rx.throttle", 10000));
    }

    @Test
    public void nothingOfAFrameIsLiveAfterTheSecondIsOver() {
        assertFalse(frame.age.isSilent(10700));
        assertTrue(frame.age.isSilent(10701));
        for (String path : new String[] {"altitude", "android.batteryLevel", "armed", "vetoes"}) {
            assertEquals(path, Freshness.STALE, frame.freshness(path, 10701));
        }
    }

    @Test
    public void aLostLinkMakesEverythingStaleAtOnce() {
        final Telemetry lost = frame.withLostLink();
        assertEquals(Freshness.STALE, lost.freshness("altitude", 10000));
        assertTrue(lost.age.isSilent(10000));
        assertTrue(lost.age.isLinkLost);
        assertEquals(12, lost.number("altitude"), 0);
    }

    @Test
    public void aFrameThatWasLongOnItsWayIsLate() {
        final Telemetry late = Telemetry.of(GroundBench.json(FRAME), 7L, 10000, 3000);
        assertTrue(late.age.isSilent(10000));
        assertTrue(late.age.isLate(10000));
        assertFalse(frame.age.isLate(10000));
    }

    @Test
    public void beforeTheFirstFrameThereIsNothing() {
        assertNull(Telemetry.EMPTY.age.frameMs(5));
        assertNull(Telemetry.EMPTY.number("altitude"));
        assertTrue(Telemetry.EMPTY.age.isSilent(5));
        assertEquals(Freshness.NONE, Telemetry.EMPTY.freshness("altitude", 5));
    }

    @Test
    public void aFrameDoesNotChangeWithWhatItWasMadeOf() {
        final Map<String, Object> data =
                new LinkedHashMap<>(GroundBench.json(FRAME));
        final Telemetry made = Telemetry.of(data, 1L, 0, 0);
        data.put("altitude", 99L);
        assertEquals(12, made.number("altitude"), 0);
        assertThrows(UnsupportedOperationException.class, () ->
                made.object("location").put("latitude", 1.0));
        assertSame(Double.class, made.number("location.latitude").getClass());
    }

    @Test
    public void whateverAFrameSaysNothingIsThrown() {
        final long seed = new Random().nextLong();
        final Random random = new Random(seed);
        final String[] paths = {"orientation.roll", "age_ms.flight", "vetoes", "location",
            "location.latitude", "armed", "a.b.c", "home.distance"};
        for (int each = 0; each < 3000; each++) {
            final Map<String, Object> data = new LinkedHashMap<>();
            for (String path : paths) {
                data.put(path.substring(0, Math.max(1, path.indexOf('.'))), value(random, 3));
            }
            try {
                final Telemetry hostile = Telemetry.of(data, null, 0, 0);
                for (String path : paths) {
                    hostile.number(path);
                    hostile.flag(path);
                    hostile.text(path);
                    hostile.texts(path);
                    hostile.freshness(path, random.nextInt(2000));
                }
                final List<TelemetryRow> rows = TelemetryText.rows(hostile);
                assertTrue(rows.size() <= TelemetryText.MAX_ROWS);
                new Track().update(hostile, null, 0);
                new HomeEstimator().update(hostile);
                new EventMonitor(new EventLog(), new Alarms()).update(hostile,
                        new GroundStatus(new LinkStatus(), false, new TelemetryStream(), 0), 0);
            } catch (RuntimeException fault) {
                throw new AssertionError("seed " + seed, fault);
            }
        }
    }

    private static Object value(Random random, int depth) {
        switch (random.nextInt(depth > 0 ? 9 : 6)) {
            case 0:
                return null;
            case 1:
                return random.nextBoolean();
            case 2:
                return random.nextLong();
            case 3:
                return (random.nextDouble() - 0.5) * Math.pow(10, random.nextInt(30));
            case 4:
                return "\ud800\u0007\u202e" + random.nextInt();
            case 5:
                return new BigInteger(80, random);
            case 6:
                return Arrays.asList(value(random, depth - 1), value(random, depth - 1));
            default:
                final Map<String, Object> fields = new LinkedHashMap<>();
                fields.put("roll", value(random, depth - 1));
                fields.put("latitude", value(random, depth - 1));
                fields.put("longitude", value(random, depth - 1));
                fields.put("", value(random, depth - 1));
                return fields;
        }
    }
}
