package org.raspilot.app.view;

/** Directions on a compass, in degrees clockwise from north. */
public final class CompassGeometry {
    private CompassGeometry() {
    }

    /** Returns the same direction in 0 (included) to 360 (not included). */
    public static float wrapped(float directionDeg) {
        float rest = directionDeg % 360;
        float positive = rest < 0 ? rest + 360 : rest;
        return positive >= 360 ? 0 : positive;
    }

    /** Returns the shorter turn from one direction to another, -180 to 180. */
    public static float turn(float fromDeg, float toDeg) {
        float turn = wrapped(toDeg - fromDeg);
        return turn > 180 ? turn - 360 : turn;
    }

    /** Returns the direction in three figures, 000 to 359. */
    public static String figures(float directionDeg) {
        int whole = Math.round(wrapped(directionDeg)) % 360;
        return (whole < 10 ? "00" : whole < 100 ? "0" : "") + whole;
    }

    /**
     * Returns a point, from north on, each 45 degrees, degrees each other 30, otherwise an empty
     * text.
     */
    public static String label(int directionDeg, String[] points) {
        int whole = ((directionDeg % 360) + 360) % 360;
        if (whole % 45 == 0) {
            return points[whole / 45];
        }
        return whole % 30 == 0 ? Integer.toString(whole) : "";
    }

    /** Returns the nearest of the eight points, which begin at north. */
    public static String point(float directionDeg, String[] points) {
        return points[Math.round(wrapped(directionDeg) / 45) % 8];
    }
}
