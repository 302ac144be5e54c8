package org.raspilot.up.ground;

/**
 * Computes home from the aircraft's position, its distance and its bearing; keeps the first result,
 * and replaces it only if home moved.
 */
final class HomeEstimator {
    private static final double MOVED_M = 20;
    private static final double MAX_DISTANCE_M = 1e6;

    private Home home;

    /** Returns it; null: not known. */
    Home home() {
        return home;
    }

    void update(Telemetry telemetry) {
        final Double latitude = telemetry.number("location.latitude");
        final Double longitude = telemetry.number("location.longitude");
        final Double distance = telemetry.number("home.distance");
        final Double bearing = telemetry.number("home.bearing");
        if (latitude == null || longitude == null || distance == null || bearing == null
                || Math.abs(latitude) > 90 || Math.abs(longitude) > 180
                || !(distance >= 0 && distance <= MAX_DISTANCE_M)) {
            return;
        }
        final Home found = destination(latitude, longitude, bearing, distance);
        if (home == null || Earth.distanceM(home.latitudeDeg, home.longitudeDeg,
                found.latitudeDeg, found.longitudeDeg) > MOVED_M) {
            home = found;
        }
    }

    /** Returns the point at that distance on the great circle with that initial bearing. */
    static Home destination(double latitudeDeg, double longitudeDeg, double bearingDeg,
            double distanceM) {
        final double north = Math.toRadians(latitudeDeg);
        final double way = distanceM / Earth.RADIUS_M;
        final double turn = Math.toRadians(bearingDeg);
        final double there = Math.asin(Math.sin(north) * Math.cos(way)
                + Math.cos(north) * Math.sin(way) * Math.cos(turn));
        final double east = Math.toRadians(longitudeDeg)
                + Math.atan2(Math.sin(turn) * Math.sin(way) * Math.cos(north),
                        Math.cos(way) - Math.sin(north) * Math.sin(there));
        final double turned = (Math.toDegrees(east) + 540) % 360 - 180;
        return new Home(Math.toDegrees(there), turned);
    }
}
