package org.raspilot.app.view;

import android.content.Context;
import android.graphics.Canvas;
import android.graphics.Path;
import android.util.AttributeSet;
import org.raspilot.app.R;

/** The heading on a horizontal tape, with the direction of home. */
public final class CompassView extends Instrument {
    private static final int STEP_DEG = 5;
    private static final int LABEL_EACH = 3;
    private static final float MARK_DP = 13;

    private final TapeGeometry geometry = new TapeGeometry(STEP_DEG);
    private final String[] names = new String[360 / STEP_DEG / LABEL_EACH];
    private final Path pointer = new Path();
    private float headingDeg;
    private float homeDeg = Float.NaN;
    private String figures = UNKNOWN;
    private final String homeLetter;
    private final String[] points;

    public CompassView(Context context, AttributeSet attributes) {
        super(context, attributes);
        points = getResources().getStringArray(R.array.view_points);
        for (int each = 0; each < names.length; each++) {
            names[each] = CompassGeometry.label(each * STEP_DEG * LABEL_EACH, points);
        }
        homeLetter = context.getString(R.string.view_home_letter);
    }

    /** Takes the directions of nose and home, degrees clockwise from north; null: unknown. */
    public void setHeading(double heading, Double home) {
        float homeNow = home == null ? Float.NaN : home.floatValue();
        if (figures != UNKNOWN && (float) heading == headingDeg
                && Float.compare(homeNow, homeDeg) == 0) {
            return;
        }
        headingDeg = CompassGeometry.wrapped((float) heading);
        homeDeg = homeNow;
        figures = CompassGeometry.figures(headingDeg);
        invalidate();
    }

    @Override
    protected void onSizeChanged(int width, int height, int oldWidth, int oldHeight) {
        super.onSizeChanged(width, height, oldWidth, oldHeight);
        geometry.resize(width, dp(MARK_DP));
        pointer.reset();
        pointer.moveTo(0, height - dp(2));
        pointer.lineTo(-dp(7), height);
        pointer.lineTo(0, height - dp(11));
        pointer.lineTo(dp(7), height);
        pointer.close();
    }

    @Override
    protected void drawReadings(Canvas canvas) {
        geometry.show(headingDeg);
        canvas.save();
        canvas.translate(getWidth() / 2f, 0);
        for (int place = 0; place < geometry.count(); place++) {
            drawMark(canvas, place);
        }
        drawHome(canvas);
        canvas.drawPath(pointer, area(colors().ink));
        drawWindow(canvas);
        canvas.restore();
    }

    @Override
    protected float ageAcross() {
        return 0.2f;
    }

    @Override
    protected String describe() {
        String point = CompassGeometry.point(headingDeg, points);
        return getContext().getString(R.string.view_heading, figures, point);
    }

    @Override
    protected String name() {
        return getContext().getString(R.string.view_heading_name);
    }

    private void drawMark(Canvas canvas, int place) {
        float x = geometry.x(place);
        boolean isLabelled = geometry.isEach(place, LABEL_EACH);
        canvas.drawLine(x, 0, x, dp(isLabelled ? 10 : 6), line(colors().dim, 1.5f));
        if (isLabelled) {
            int of = (int) ((geometry.firstMark() + place) / LABEL_EACH);
            int name = (of % names.length + names.length) % names.length;
            centred(canvas, names[name], x, dp(10) + sp(9), 12, colors().dim);
        }
    }

    private void drawWindow(Canvas canvas) {
        float half = sp(21);
        float top = getHeight() - dp(11) - sp(20);
        canvas.drawRect(-half, top, half, top + sp(19), area(colors().ground));
        centred(canvas, figures, 0, top + sp(9.5f), 17, colors().ink);
    }

    private void drawHome(Canvas canvas) {
        if (!Float.isNaN(homeDeg)) {
            centred(canvas, homeLetter, xOf(homeDeg), getHeight() - sp(9), 13, colors().good);
        }
    }

    /** Returns the position of a direction; one beyond the picture stays at its edge. */
    private float xOf(float directionDeg) {
        float most = getWidth() / 2f - dp(8);
        float turn = CompassGeometry.turn(headingDeg, directionDeg);
        return Math.max(-most, Math.min(most, geometry.distance(turn, 0)));
    }
}
