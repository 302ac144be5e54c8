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

    /** Returns the latitude of a place so far north of another, degrees. */
    public static double latitudeDeg(Home from, double northM) {
        return from.latitudeDeg + Math.toDegrees(northM / RADIUS_M);
    }

    /** Returns the longitude of a place so far east of another, -180 to 180 degrees. */
    public static double longitudeDeg(Home from, double eastM) {
        final double cosine = Math.cos(Math.toRadians(from.latitudeDeg));
        final double deg = from.longitudeDeg + Math.toDegrees(eastM / (RADIUS_M * cosine));
        return deg - Math.rint(deg / 360) * 360;
    }

    /** Returns how far two places are from each other, m; all in degrees. */
    public static double distanceM(double fromLatitudeDeg, double fromLongitudeDeg,
            double toLatitudeDeg, double toLongitudeDeg) {
        return Math.hypot(northM(fromLatitudeDeg, toLatitudeDeg),
                eastM(fromLongitudeDeg, toLongitudeDeg,
                        (fromLatitudeDeg + toLatitudeDeg) / 2));
    }
}
