package org.raspilot.up.ground;

/** Metres between places near each other: flat is near enough as far as a model aircraft flies. */
public final class Earth {
    /** Mean radius, m. */
    public static final double RADIUS_M = 6371008.8;

    private Earth() {
    }

    /** Returns how far north the second latitude is of the first, m. */
    public static double northM(double fromDeg, double toDeg) {
        return Math.toRadians(toDeg - fromDeg) * RADIUS_M;
    }

    /** Returns how far east the second longitude is of the first at a latitude, m; not around. */
    public static double eastM(double fromDeg, double toDeg, double latitudeDeg) {
        final double apartDeg = toDeg - fromDeg;
        final double shorterDeg = apartDeg - Math.rint(apartDeg / 360) * 360;
        return Math.toRadians(shorterDeg) * RADIUS_M * Math.cos(Math.toRadians(latitudeDeg));
    }

    /** Returns how far two places are from each other, m; all in degrees. */
    public static double distanceM(double fromLatitudeDeg, double fromLongitudeDeg,
            double toLatitudeDeg, double toLongitudeDeg) {
        return Math.hypot(northM(fromLatitudeDeg, toLatitudeDeg),
                eastM(fromLongitudeDeg, toLongitudeDeg,
                        (fromLatitudeDeg + toLatitudeDeg) / 2));
    }
}
