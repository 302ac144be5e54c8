package org.raspilot.up.ground;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertFalse;
import static org.junit.Assert.assertNotSame;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertSame;
import static org.junit.Assert.assertTrue;

import java.util.ArrayList;
import java.util.List;
import org.junit.Test;
import org.raspilot.up.ground.Track.TrackPoint;

/** The track of the aircraft. */
public final class TrackTest {
    private static final double DEGREE_M = 111195;

    private final Track track = new Track();
    private long nowMs = 100000;

    private void fly(double northM, double eastM, Home home) {
        nowMs += 100;
        track.update(GroundBench.telemetry("{\"location\": {\"latitude\": "
                + (60 + northM / DEGREE_M) + ", \"longitude\": "
                + (15 + eastM / DEGREE_M / 0.5) + ", \"altitude\": 30}}", nowMs), home, nowMs);
    }

    /** Returns the track and the aircraft's position, if it is not in the track. */
    private List<TrackPoint> points() {
        final Track.Snapshot now = track.snapshot();
        final List<TrackPoint> all = new ArrayList<>(now.points);
        if (now.newest != null && !all.contains(now.newest)) {
            all.add(now.newest);
        }
        return all;
    }

    @Test
    public void pointsAreMetresFromTheFirstPlaceAndLaterFromHome() {
        assertNull(track.snapshot().origin);
        fly(0, 0, null);
        fly(100, 50, null);
        assertEquals(100, points().get(1).northM, 0.1);
        assertEquals(50, points().get(1).eastM, 0.1);
        assertFalse(track.snapshot().isOriginHome);
        final Home home = new Home(60 - 10 / DEGREE_M, 15);
        fly(200, 50, home);
        assertTrue(track.snapshot().isOriginHome);
        assertEquals(110, points().get(1).northM, 0.1);
        assertEquals(3, points().size());
    }

    @Test
    public void pointsAreTwoMetresApartAndTheNewestPlaceIsTheLast() {
        for (int each = 0; each <= 10; each++) {
            fly(each * 0.5, 0, null);
        }
        assertEquals(4, points().size());
        assertEquals(5, points().get(3).northM, 0.01);
        final long version = track.version();
        fly(5, 0, null);
        assertTrue(track.version() > version);
        assertEquals(4, points().size());
    }

    @Test
    public void aFrameWithoutAPointOfItsOwnCopiesNoPoint() {
        fly(0, 0, null);
        fly(100, 0, null);
        final List<TrackPoint> way = track.snapshot().points;
        final TrackPoint first = way.get(0);
        fly(101, 0, null);
        assertSame(way, track.snapshot().points);
        assertEquals(101, track.snapshot().newest.northM, 0.01);
        fly(103, 0, null);
        assertEquals(2, way.size());
        assertEquals(3, track.snapshot().points.size());
        assertSame("made once", first, track.snapshot().points.get(0));
        assertSame(track.snapshot().newest, track.snapshot().points.get(2));
        fly(103, 0, new Home(60, 15.1));
        assertNotSame(first, track.snapshot().points.get(0));
        assertEquals(3, track.snapshot().points.size());
    }

    @Test
    public void noLineLeadsOverASilence() {
        for (int each = 0; each < 10; each++) {
            fly(each * 10, 0, null);
        }
        nowMs += 5000;
        fly(500, 0, null);
        fly(510, 0, null);
        final List<TrackPoint> points = points();
        assertFalse(points.get(9).isAfterSilence);
        assertTrue(points.get(10).isAfterSilence);
        assertFalse(points.get(11).isAfterSilence);
    }

    @Test
    public void thereAreNeverMoreThanSomeThousandAndASilenceIsNotThinnedAway() {
        for (int each = 0; each < 1001; each++) {
            fly(each * 3, 0, null);
        }
        nowMs += 5000;
        for (int each = 1001; each < 20000; each++) {
            fly(each * 3, 0, null);
        }
        final List<TrackPoint> points = points();
        assertTrue("" + points.size(), points.size() <= Track.MAX_POINTS + 1);
        assertTrue("" + points.size(), points.size() >= Track.MAX_POINTS / 2 - 1);
        assertEquals(0, points.get(0).northM, 0.01);
        assertEquals(19999 * 3, points.get(points.size() - 1).northM, 0.1);
        int silences = 0;
        for (TrackPoint each : points) {
            silences += each.isAfterSilence ? 1 : 0;
        }
        assertEquals(1, silences);
    }

    @Test
    public void whatIsNoPlaceIsNoPoint() {
        for (String place : new String[] {"{}", "{\"location\": null}",
            "{\"location\": {\"latitude\": 91, \"longitude\": 0}}",
            "{\"location\": {\"latitude\": 0, \"longitude\": 181}}",
            "{\"location\": {\"latitude\": \"49\", \"longitude\": 15}}",
            "{\"location\": {\"latitude\": 49}}"}) {
            track.update(GroundBench.telemetry(place, nowMs), null, nowMs);
        }
        assertTrue(points().isEmpty());
    }

    @Test
    public void overTheDateLineItIsNotAroundTheWorld() {
        track.update(GroundBench.telemetry(
                "{\"location\": {\"latitude\": 0, \"longitude\": 179.9999}}", 1), null, 1);
        track.update(GroundBench.telemetry(
                "{\"location\": {\"latitude\": 0, \"longitude\": -179.9999}}", 2), null, 2);
        assertEquals(0.0002 * DEGREE_M, points().get(1).eastM, 0.01);
    }

    @Test
    public void anySnapshotStaysWhatItWas() {
        fly(0, 0, null);
        final List<TrackPoint> before = points();
        fly(100, 0, null);
        assertEquals(1, before.size());
    }

    @Test
    public void homeIsFoundFromPlaceDistanceAndBearingAndOnlyAMoveReplacesIt() {
        final HomeEstimator search = new HomeEstimator();
        search.update(home(100));
        final Home first = search.home();
        search.update(home(110));
        assertEquals(first, search.home());
        search.update(home(150));
        assertEquals(50, Earth.distanceM(first.latitudeDeg,
                first.longitudeDeg, search.home().latitudeDeg, search.home().longitudeDeg), 0.1);
        search.update(home(-5));
        search.update(home(1e9));
        assertEquals(50, Earth.distanceM(first.latitudeDeg,
                first.longitudeDeg, search.home().latitudeDeg, search.home().longitudeDeg), 0.1);
    }

    private static Telemetry home(double distance) {
        return GroundBench.telemetry("{\"location\": {\"latitude\": 49, \"longitude\": 15},"
                + " \"home\": {\"bearing\": 90, \"distance\": " + distance + "}}", 0);
    }
}
