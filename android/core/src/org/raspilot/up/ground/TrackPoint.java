package org.raspilot.up.ground;

/** One place of the track. Immutable. */
public final class TrackPoint {
    /** The metres north of the track's origin. */
    public final double northM;
    /** The metres east of the track's origin. */
    public final double eastM;
    /** The altitude, m; null: not known. */
    public final Double altitudeM;
    /** Whether a gap precedes it: no line leads to it. */
    public final boolean isAfterSilence;

    TrackPoint(double northM, double eastM, Double altitudeM, boolean isAfterSilence) {
        this.northM = northM;
        this.eastM = eastM;
        this.altitudeM = altitudeM;
        this.isAfterSilence = isAfterSilence;
    }
}
