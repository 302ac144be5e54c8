package org.raspilot.app.view;

/**
 * Converts metres north and east of home to pixels of a picture with north up.
 *
 * <p>Until the user moves it, it shows everything: home, the track and the aircraft. It uses a
 * plane around home instead of a map projection; the error is a metre in a field and a percent in
 * 100 km.
 */
public final class TrackGeometry {
    private static final double MIN_PIXELS_PER_M = 1e-4;
    private static final double MAX_PIXELS_PER_M = 40;
    /** The minimum span of the picture, m. */
    private static final double MIN_SPAN_M = 40;
    private static final double MARGIN = 0.12;

    private float width = 1;
    private float height = 1;
    private double northM;
    private double eastM;
    private double pixelsPerM = 1;
    private boolean isAutomatic = true;

    /** Takes the size of the picture, pixels. */
    public void resize(float newWidth, float newHeight) {
        width = Math.max(1, newWidth);
        height = Math.max(1, newHeight);
    }

    /** Returns whether the picture chooses its section automatically. */
    public boolean isAutomatic() {
        return isAutomatic;
    }

    /** Makes the picture choose its section automatically again. */
    public void follow() {
        isAutomatic = true;
    }

    /** Shows all of a rectangle, metres from home, unless the user has moved the picture. */
    public void fit(double southM, double mostNorthM, double westM, double mostEastM) {
        if (!isAutomatic) {
            return;
        }
        northM = (southM + mostNorthM) / 2;
        eastM = (westM + mostEastM) / 2;
        double spanNorthM = Math.max(MIN_SPAN_M, mostNorthM - southM);
        double spanEastM = Math.max(MIN_SPAN_M, mostEastM - westM);
        double room = 1 - 2 * MARGIN;
        scaleTo(Math.min(height * room / spanNorthM, width * room / spanEastM));
    }

    /** Moves the picture by a finger's movement, pixels. */
    public void drag(float rightPx, float downPx) {
        isAutomatic = false;
        eastM -= rightPx / pixelsPerM;
        northM += downPx / pixelsPerM;
    }

    /**
     * Enlarges the picture around a fixed point, pixels; no effect if the factor is not above 0.
     */
    public void zoom(double factor, float x, float y) {
        if (!(factor > 0) || Double.isInfinite(factor)) {
            return;
        }
        isAutomatic = false;
        double atEastM = eastAt(x);
        double atNorthM = northAt(y);
        scaleTo(pixelsPerM * factor);
        eastM = atEastM - (x - width / 2) / pixelsPerM;
        northM = atNorthM + (y - height / 2) / pixelsPerM;
    }

    /** Restores a stored section: see the getters. */
    public void restore(double middleNorthM, double middleEastM, double scalePixelsPerM) {
        isAutomatic = false;
        northM = middleNorthM;
        eastM = middleEastM;
        scaleTo(scalePixelsPerM);
    }

    /** Returns metres north of home in the middle of the picture. */
    public double middleNorthM() {
        return northM;
    }

    /** Returns metres east of home in the middle of the picture. */
    public double middleEastM() {
        return eastM;
    }

    /** Returns the scale, pixels a metre. */
    public double pixelsPerM() {
        return pixelsPerM;
    }

    /** Returns the horizontal position of a place, pixels from the left. */
    public float x(double placeEastM) {
        return (float) (width / 2 + (placeEastM - eastM) * pixelsPerM);
    }

    /** Returns the vertical position of a place, pixels from the top. */
    public float y(double placeNorthM) {
        return (float) (height / 2 - (placeNorthM - northM) * pixelsPerM);
    }

    /** Returns metres east of home for a distance in pixels from the left. */
    public double eastAt(float x) {
        return eastM + (x - width / 2) / pixelsPerM;
    }

    /** Returns metres north of home for a distance in pixels from the top. */
    public double northAt(float y) {
        return northM - (y - height / 2) / pixelsPerM;
    }

    /**
     * Returns the distance between two lines of the grid, metres: 1, 2 or 5 times a power of ten.
     */
    public double gridStepM(float leastPx) {
        double leastM = Math.max(1e-3, leastPx / pixelsPerM);
        double power = Math.pow(10, Math.floor(Math.log10(leastM)));
        double share = leastM / power;
        double round = share <= 1 ? 1 : share <= 2 ? 2 : share <= 5 ? 5 : 10;
        return round * power;
    }

    /** Returns the first line of a grid that is not less than a place, metres. */
    public static double firstLineM(double leastM, double stepM) {
        return Math.ceil(leastM / stepM) * stepM;
    }

    /** Formats a distance: {@code 250 m}, {@code 2.5 km}. */
    public static String distanceText(double metres) {
        double away = Math.abs(metres);
        if (away < 999.5) {
            boolean isFine = away < 1 && away > 0;
            return isFine ? tenths(away) + " m" : Math.round(away) + " m";
        }
        double km = away / 1000;
        boolean isWhole = km >= 99.95 || Math.abs(km - Math.rint(km)) < 0.005;
        return (isWhole ? Long.toString(Math.round(km)) : tenths(km)) + " km";
    }

    private static String tenths(double value) {
        long tenths = Math.round(value * 10);
        return tenths / 10 + "." + tenths % 10;
    }

    private void scaleTo(double wanted) {
        pixelsPerM = Math.max(MIN_PIXELS_PER_M, Math.min(MAX_PIXELS_PER_M, wanted));
    }
}
