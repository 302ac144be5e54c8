package org.raspilot.up.ground;

/** One place of the track. Immutable. */
public final class TrackPoint {
    private final double northM;
    private final double eastM;
    private final Double altitudeM;
    private final boolean isAfterSilence;

    TrackPoint(double northM, double eastM, Double altitudeM, boolean isAfterSilence) {
        this.northM = northM;
        this.eastM = eastM;
        this.altitudeM = altitudeM;
        this.isAfterSilence = isAfterSilence;
    }

    /** Returns the metres north of the track's origin. */
    public double northM() {
        return northM;
    }

    /** Returns the metres east of the track's origin. */
    public double eastM() {
        return eastM;
    }

    /** Returns the altitude, m; null: not known. */
    public Double altitudeM() {
        return altitudeM;
    }

    /** Returns whether a gap precedes it: no line leads to it. */
    public boolean isAfterSilence() {
        return isAfterSilence;
    }
}
