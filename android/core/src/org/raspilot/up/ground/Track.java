package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;

/**
 * The track of the aircraft, in metres from its home: points at least
 * {@link #MIN_DISTANCE_M} apart; when there are too many, every second one is dropped. Only on the
 * loop.
 */
public final class Track {
    public static final int MAX_POINTS = 4000;
    /** Points are not nearer to each other, m. */
    public static final double MIN_DISTANCE_M = 2;

    /** A snapshot of the track. Immutable. */
    public static final class Snapshot {
        public final long version;
        /** The position of north 0, east 0; null before the first position. */
        public final Home origin;
        /** Whether the origin is home; otherwise it is the first known position. */
        public final boolean isOriginHome;
        /**
         * The points from the oldest on, unmodifiable; the same list until one is added or
         * the origin moves.
         */
        public final List<TrackPoint> points;
        /** The aircraft's position, which may not be on the track yet; null: unknown. */
        public final TrackPoint newest;

        Snapshot(long version, Home origin, boolean isOriginHome, List<TrackPoint> points,
                TrackPoint newest) {
            this.version = version;
            this.origin = origin;
            this.isOriginHome = isOriginHome;
            this.points = points;
            this.newest = newest;
        }
    }

    private static final class Spot {
        final double latitudeDeg;
        final double longitudeDeg;
        final boolean isAfterSilence;

        Spot(double latitudeDeg, double longitudeDeg, boolean isAfterSilence) {
            this.latitudeDeg = latitudeDeg;
            this.longitudeDeg = longitudeDeg;
            this.isAfterSilence = isAfterSilence;
        }
    }

    private List<Spot> spots = new ArrayList<>();
    private Spot newest;
    private Home home;
    private Home firstPlace;
    private final PositionGaps gaps = new PositionGaps();
    private boolean isAfterSilence;
    private long version;
    private final List<TrackPoint> points = new ArrayList<>();
    private Home pointsOrigin;
    private Snapshot snapshot =
            new Snapshot(0, null, false, Collections.emptyList(), null);

    Track() {
    }

    public long version() {
        return version;
    }

    public Snapshot snapshot() {
        if (snapshot.version != version) {
            final Home origin = home == null ? firstPlace : home;
            final List<TrackPoint> way = way(origin);
            TrackPoint place = null;
            if (newest != null) {
                place = newest == lastSpot() ? way.get(way.size() - 1) : point(origin, newest);
            }
            snapshot = new Snapshot(version, origin, home != null, way, place);
        }
        return snapshot;
    }

    /** Takes the position of a frame, if it has a valid one; time only increases. */
    void update(Telemetry telemetry, Home known, long nowMs) {
        if (known != null && known != home) {
            home = known;
            version++;
        }
        final Double latitude = telemetry.number("location.latitude");
        final Double longitude = telemetry.number("location.longitude");
        if (latitude == null || longitude == null || Math.abs(latitude) > 90
                || Math.abs(longitude) > 180) {
            return;
        }
        if (!telemetry.age.isStale("location", nowMs)) {
            isAfterSilence |= gaps.update(nowMs);
        }
        if (firstPlace == null) {
            firstPlace = new Home(latitude, longitude);
        }
        newest = new Spot(latitude, longitude, isAfterSilence && !spots.isEmpty());
        version++;
        if (spots.isEmpty() || distanceM(lastSpot(), newest) >= MIN_DISTANCE_M) {
            isAfterSilence = false;
            spots.add(newest);
            if (spots.size() >= MAX_POINTS) {
                thin();
            }
        }
    }

    /** Drops every second point; the information of a dropped point moves to the next one. */
    private void thin() {
        final List<Spot> kept = new ArrayList<>();
        boolean hasGap = false;
        for (int place = 0; place < spots.size(); place++) {
            final Spot spot = spots.get(place);
            hasGap |= spot.isAfterSilence;
            if (place % 2 == 0 || place == spots.size() - 1) {
                kept.add(hasGap == spot.isAfterSilence ? spot : new Spot(spot.latitudeDeg,
                        spot.longitudeDeg, hasGap));
                hasGap = false;
            }
        }
        newest = kept.get(kept.size() - 1);
        spots = kept;
        pointsOrigin = null;
    }

    private Spot lastSpot() {
        return spots.isEmpty() ? null : spots.get(spots.size() - 1);
    }

    /** Returns the points of all spots; each is created once while the origin stays. */
    private List<TrackPoint> way(Home origin) {
        if (pointsOrigin != origin) {
            pointsOrigin = origin;
            points.clear();
        } else if (points.size() == spots.size()) {
            return snapshot.points;
        }
        for (Spot each : spots.subList(points.size(), spots.size())) {
            points.add(point(origin, each));
        }
        return Collections.unmodifiableList(new ArrayList<>(points));
    }

    private static TrackPoint point(Home origin, Spot spot) {
        return new TrackPoint(Earth.northM(origin.latitudeDeg, spot.latitudeDeg),
                Earth.eastM(origin.longitudeDeg, spot.longitudeDeg, origin.latitudeDeg),
                spot.isAfterSilence);
    }

    private static double distanceM(Spot a, Spot b) {
        return Earth.distanceM(a.latitudeDeg, a.longitudeDeg, b.latitudeDeg, b.longitudeDeg);
    }

    /** One place of the track. Immutable. */
    public static final class TrackPoint {
        public final double northM;
        public final double eastM;
        /** Whether a gap precedes it: no line leads to it. */
        public final boolean isAfterSilence;

        TrackPoint(double northM, double eastM, boolean isAfterSilence) {
            this.northM = northM;
            this.eastM = eastM;
            this.isAfterSilence = isAfterSilence;
        }
    }

    /** Detects gaps in the known positions; the track has no line across a gap. */
    static final class PositionGaps {
        /** A longer time without a position, ms, is a gap, unless their period is longer. */
        private static final long GAP_MS = 900;
        private static final double PERIODS = 2.5;
        private static final int INTERVALS = 5;

        private final long[] intervalsMs = new long[INTERVALS];
        private int intervals;
        private Long knownMs;

        /** Takes a known position; returns whether it ends a gap. */
        boolean update(long nowMs) {
            final Long beforeMs = knownMs;
            knownMs = nowMs;
            if (beforeMs == null) {
                return false;
            }
            final double periodMs = periodMs();
            intervalsMs[intervals % INTERVALS] = nowMs - beforeMs;
            intervals++;
            return nowMs - beforeMs > Math.max(GAP_MS, PERIODS * periodMs);
        }

        /** Returns the median time between the last positions; 0: unknown. */
        private double periodMs() {
            if (intervals < INTERVALS) {
                return 0;
            }
            final long[] sorted = intervalsMs.clone();
            Arrays.sort(sorted);
            return sorted[INTERVALS / 2];
        }
    }
}
