package org.raspilot.up.ground;

import java.util.Collections;
import java.util.List;

/** The way that the aircraft has come, in metres from its home. Only on the loop. */
public final class Track {
    /** So many points at most. */
    public static final int MOST_POINTS = 4000;

    /** The track of a moment. Immutable. */
    public static final class Snapshot {
        private final long version;
        private final Home origin;
        private final boolean isOriginHome;
        private final List<TrackPoint> points;

        Snapshot(long version, Home origin, boolean isOriginHome, List<TrackPoint> points) {
            this.version = version;
            this.origin = origin;
            this.isOriginHome = isOriginHome;
            this.points = points;
        }

        /** Returns a number that rises with each change. */
        public long version() {
            return version;
        }

        /** Returns where north 0, east 0 lies; null before the first place. */
        public Home origin() {
            return origin;
        }

        /** Says whether the origin is the aircraft's home; else it is the first place heard. */
        public boolean isOriginHome() {
            return isOriginHome;
        }

        /** Returns the points from the oldest to the newest, which is where it is; unmodifiable. */
        public List<TrackPoint> points() {
            return points;
        }
    }

    private Snapshot snapshot =
            new Snapshot(0, null, false, Collections.<TrackPoint>emptyList());

    /** Returns the track of now. */
    public Snapshot snapshot() {
        return snapshot;
    }

    /** Forgets the way that was come. */
    public void clear() {
    }
}
