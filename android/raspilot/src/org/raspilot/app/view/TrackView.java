package org.raspilot.app.view;

import android.content.Context;
import android.graphics.Canvas;
import android.graphics.Path;
import android.os.Bundle;
import android.os.Parcelable;
import android.util.AttributeSet;
import android.view.GestureDetector;
import android.view.MotionEvent;
import android.view.ScaleGestureDetector;
import org.raspilot.app.R;

/**
 * The track of the aircraft without a map: north up, home in the middle of a metric grid.
 *
 * <p>It shows everything until the user drags or pinches; a double tap or {@link #follow()}
 * restores that. Metres are north and east of the origin: home, or the first known position.
 */
public final class TrackView extends Instrument {
    private static final float GRID_DP = 56;
    private static final double BUTTON_FACTOR = 1.6;
    private static final String OUTER = "outer";
    private static final String NORTH = "north";
    private static final String EAST = "east";
    private static final String SCALE = "scale";

    /** Called when a place was tapped. */
    public interface TapListener {
        /** Takes the place, metres from the origin of the track. */
        void onTap(double northM, double eastM);
    }

    private final TrackGeometry geometry = new TrackGeometry();
    private final ScaleGestureDetector pinch;
    private final GestureDetector drag;
    private final Path arrow = new Path();
    private final String homeLetter;
    private final String[] points;
    private float[] northM = new float[0];
    private float[] eastM = new float[0];
    private boolean[] isBreak = new boolean[0];
    private int count;
    private boolean isOriginHome;
    private float[] lines = new float[0];
    private double aircraftNorthM = Double.NaN;
    private double aircraftEastM = Double.NaN;
    private double headingDeg = Double.NaN;
    private double targetNorthM = Double.NaN;
    private double targetEastM = Double.NaN;
    private double targetRadiusM;
    private TapListener tapListener;
    private double stepM;
    private String stepText = "";

    public TrackView(Context context, AttributeSet attributes) {
        super(context, attributes);
        pinch = new ScaleGestureDetector(context, new Pinch());
        drag = new GestureDetector(context, new Drag());
        homeLetter = context.getString(R.string.view_home_letter);
        points = getResources().getStringArray(R.array.view_points);
        arrow.moveTo(0, -dp(11));
        arrow.lineTo(dp(7), dp(9));
        arrow.lineTo(0, dp(4));
        arrow.lineTo(-dp(7), dp(9));
        arrow.close();
    }

    /**
     * Takes metres from the origin, the oldest point first; a gap has no line to the point after
     * it.
     */
    public void setTrack(float[] north, float[] east, boolean[] hasGapBefore, boolean isHome) {
        isOriginHome = isHome;
        northM = north;
        eastM = east;
        isBreak = hasGapBefore;
        count = north.length;
        if (lines.length < 4 * count) {
            lines = new float[4 * count + 400];
        }
        refit();
    }

    /** Takes the aircraft's position, metres, and its heading, degrees; null: unknown. */
    public void setAircraft(Double north, Double east, Double heading) {
        aircraftNorthM = north == null || east == null ? Double.NaN : north;
        aircraftEastM = north == null || east == null ? Double.NaN : east;
        headingDeg = heading == null ? Double.NaN : heading;
        refit();
    }

    /** Takes the target of the flight mode and the circle around it, metres; null: none. */
    public void setTarget(Double north, Double east, Double radius) {
        targetNorthM = north == null || east == null ? Double.NaN : north;
        targetEastM = north == null || east == null ? Double.NaN : east;
        targetRadiusM = radius == null ? 0 : radius;
        invalidate();
    }

    public void setTapListener(TapListener listener) {
        tapListener = listener;
    }

    public void follow() {
        geometry.follow();
        refit();
    }

    public void enlarge() {
        zoomMiddle(BUTTON_FACTOR);
    }

    public void shrink() {
        zoomMiddle(1 / BUTTON_FACTOR);
    }

    @Override
    protected void onSizeChanged(int width, int height, int oldWidth, int oldHeight) {
        super.onSizeChanged(width, height, oldWidth, oldHeight);
        // The scale below is not drawn upon.
        geometry.resize(width, Math.max(1, height - dp(26)));
        refit();
    }

    @Override
    public boolean onTouchEvent(MotionEvent event) {
        if (event.getActionMasked() == MotionEvent.ACTION_DOWN && getParent() != null) {
            getParent().requestDisallowInterceptTouchEvent(true);
        }
        pinch.onTouchEvent(event);
        drag.onTouchEvent(event);
        return true;
    }

    @Override
    protected void drawReadings(Canvas canvas) {
        drawGrid(canvas);
        drawTrack(canvas);
        drawHome(canvas);
        drawTarget(canvas);
        drawAircraft(canvas);
        drawScale(canvas);
        drawNorth(canvas);
    }

    @Override
    protected boolean isAgeAbove() {
        return true;
    }

    @Override
    protected String describe() {
        if (Double.isNaN(aircraftNorthM)) {
            return getContext().getString(R.string.view_track_unknown, count);
        }
        double away = Math.hypot(aircraftNorthM, aircraftEastM);
        double bearing = Math.toDegrees(Math.atan2(aircraftEastM, aircraftNorthM));
        return getContext().getString(R.string.view_track, TrackGeometry.distanceText(away),
                CompassGeometry.point((float) bearing, points));
    }

    @Override
    protected String name() {
        return getContext().getString(R.string.view_track_name);
    }

    @Override
    protected Parcelable onSaveInstanceState() {
        Bundle state = new Bundle();
        state.putParcelable(OUTER, super.onSaveInstanceState());
        if (!geometry.isAutomatic()) {
            state.putDouble(NORTH, geometry.middleNorthM());
            state.putDouble(EAST, geometry.middleEastM());
            state.putDouble(SCALE, geometry.pixelsPerM());
        }
        return state;
    }

    @Override
    protected void onRestoreInstanceState(Parcelable saved) {
        if (!(saved instanceof Bundle)) {
            super.onRestoreInstanceState(saved);
            return;
        }
        Bundle state = (Bundle) saved;
        super.onRestoreInstanceState(state.getParcelable(OUTER));
        if (state.containsKey(SCALE)) {
            geometry.restore(state.getDouble(NORTH), state.getDouble(EAST),
                    state.getDouble(SCALE));
            refit();
        }
    }

    private void zoomMiddle(double factor) {
        geometry.zoom(factor, getWidth() / 2f, getHeight() / 2f);
        refit();
    }

    /** Chooses the section of the world, creates its texts, and draws soon. */
    private void refit() {
        boolean isThere = !Double.isNaN(aircraftNorthM);
        double south = isThere ? Math.min(0, aircraftNorthM) : 0;
        double north = isThere ? Math.max(0, aircraftNorthM) : 0;
        double west = isThere ? Math.min(0, aircraftEastM) : 0;
        double east = isThere ? Math.max(0, aircraftEastM) : 0;
        for (int point = 0; point < count; point++) {
            south = Math.min(south, northM[point]);
            north = Math.max(north, northM[point]);
            west = Math.min(west, eastM[point]);
            east = Math.max(east, eastM[point]);
        }
        geometry.fit(south, north, west, east);
        double step = geometry.gridStepM(dp(GRID_DP));
        if (step != stepM) {
            stepM = step;
            stepText = TrackGeometry.distanceText(step);
        }
        invalidate();
    }

    private void drawGrid(Canvas canvas) {
        double eastMost = geometry.eastAt(getWidth());
        double southMost = geometry.northAt(getHeight());
        line(colors().line, 1);
        for (double at = TrackGeometry.firstLineM(geometry.eastAt(0), stepM); at <= eastMost;
                at += stepM) {
            float x = geometry.x(at);
            canvas.drawLine(x, 0, x, getHeight(), pen);
        }
        double northMost = geometry.northAt(0);
        for (double at = TrackGeometry.firstLineM(southMost, stepM); at <= northMost;
                at += stepM) {
            float y = geometry.y(at);
            canvas.drawLine(0, y, getWidth(), y, pen);
        }
    }

    private void drawTrack(Canvas canvas) {
        int filled = 0;
        for (int point = 1; point < count; point++) {
            if (!isBreak[point]) {
                lines[filled++] = geometry.x(eastM[point - 1]);
                lines[filled++] = geometry.y(northM[point - 1]);
                lines[filled++] = geometry.x(eastM[point]);
                lines[filled++] = geometry.y(northM[point]);
            }
        }
        canvas.drawLines(lines, 0, filled, line(colors().accent, 2));
    }

    private void drawHome(Canvas canvas) {
        float x = geometry.x(0);
        float y = geometry.y(0);
        if (!isOriginHome) {
            canvas.drawCircle(x, y, dp(3), area(colors().dim));
            return;
        }
        canvas.drawCircle(x, y, dp(10), area(colors().ground));
        canvas.drawCircle(x, y, dp(10), line(colors().good, 2));
        centred(canvas, homeLetter, x, y, 12, colors().good);
    }

    private void drawTarget(Canvas canvas) {
        if (!Double.isNaN(targetNorthM)) {
            float x = geometry.x(targetEastM);
            float y = geometry.y(targetNorthM);
            canvas.drawCircle(x, y, dp(4), area(colors().warning));
            float radius = (float) (targetRadiusM * geometry.pixelsPerM());
            canvas.drawCircle(x, y, radius, line(colors().warning, 2));
        }
    }

    private void drawAircraft(Canvas canvas) {
        if (Double.isNaN(aircraftNorthM)) {
            return;
        }
        canvas.save();
        canvas.translate(geometry.x(aircraftEastM), geometry.y(aircraftNorthM));
        if (Double.isNaN(headingDeg)) {
            canvas.drawCircle(0, 0, dp(7), line(colors().ink, 3));
        } else {
            canvas.rotate((float) headingDeg);
            canvas.drawPath(arrow, area(colors().ink));
            canvas.drawPath(arrow, line(colors().ground, 1));
        }
        canvas.restore();
    }

    private void drawScale(Canvas canvas) {
        float left = dp(10);
        float y = getHeight() - dp(12);
        float right = left + (float) (stepM * geometry.pixelsPerM());
        line(colors().ink, 2);
        canvas.drawLine(left, y, right, y, pen);
        canvas.drawLine(left, y - dp(5), left, y, pen);
        canvas.drawLine(right, y - dp(5), right, y, pen);
        centred(canvas, stepText, (left + right) / 2, y - sp(9), 12, colors().ink);
    }

    private void drawNorth(Canvas canvas) {
        float x = getWidth() - dp(14);
        canvas.drawLine(x, dp(8), x, dp(24), line(colors().ink, 2));
        canvas.drawLine(x, dp(8), x - dp(4), dp(14), pen);
        canvas.drawLine(x, dp(8), x + dp(4), dp(14), pen);
        centred(canvas, points[0], x, dp(24) + sp(8), 12, colors().ink);
    }

    private final class Pinch extends ScaleGestureDetector.SimpleOnScaleGestureListener {
        @Override
        public boolean onScale(ScaleGestureDetector of) {
            geometry.zoom(of.getScaleFactor(), of.getFocusX(), of.getFocusY());
            refit();
            return true;
        }
    }

    private final class Drag extends GestureDetector.SimpleOnGestureListener {
        @Override
        public boolean onDown(MotionEvent event) {
            return true;
        }

        @Override
        public boolean onScroll(MotionEvent from, MotionEvent to, float leftPx, float upPx) {
            geometry.drag(-leftPx, -upPx);
            refit();
            return true;
        }

        @Override
        public boolean onSingleTapConfirmed(MotionEvent event) {
            if (tapListener != null) {
                tapListener.onTap(geometry.northAt(event.getY()), geometry.eastAt(event.getX()));
            }
            return true;
        }

        @Override
        public boolean onDoubleTap(MotionEvent event) {
            follow();
            return true;
        }
    }
}
