package org.raspilot.app.view;

import android.content.Context;
import android.graphics.Canvas;
import android.graphics.Path;
import android.graphics.RectF;
import android.util.AttributeSet;
import org.raspilot.app.R;

/** The artificial horizon: attitude as one sees it from the seat, with roll scale and ladder. */
public final class AttitudeView extends Instrument {
    private static final float FAR = 8;

    private final HorizonGeometry geometry = new HorizonGeometry();
    private final RectF arc = new RectF();
    private final Path zero = new Path();
    private final Path pointer = new Path();
    private final String[] labels;
    private float rollDeg;
    private float pitchDeg;

    public AttitudeView(Context context, AttributeSet attributes) {
        super(context, attributes);
        labels = new String[geometry.rungCount()];
        for (int rung = 0; rung < labels.length; rung++) {
            labels[rung] = Integer.toString(Math.round(Math.abs(geometry.rungDeg(rung))));
        }
    }

    /** Takes an attitude, degrees: right wing down and nose up are positive. */
    public void setAttitude(double roll, double pitch) {
        if ((float) roll != rollDeg || (float) pitch != pitchDeg) {
            rollDeg = (float) roll;
            pitchDeg = (float) pitch;
            invalidate();
        }
    }

    @Override
    protected void onSizeChanged(int width, int height, int oldWidth, int oldHeight) {
        super.onSizeChanged(width, height, oldWidth, oldHeight);
        geometry.resize(width, height);
        float radius = geometry.radius();
        arc.set(-radius, -radius, radius, radius);
        triangle(zero, -radius, -radius - dp(9));
        triangle(pointer, -radius + dp(1), -radius + dp(11));
    }

    @Override
    protected void drawReadings(Canvas canvas) {
        geometry.turn(rollDeg, pitchDeg);
        canvas.save();
        canvas.translate(getWidth() / 2f, getHeight() / 2f);
        drawBall(canvas);
        drawScale(canvas);
        drawAircraft(canvas);
        canvas.restore();
    }

    @Override
    protected String describe() {
        String bank = getContext().getString(
                rollDeg < 0 ? R.string.view_left : R.string.view_right);
        String nose = getContext().getString(pitchDeg < 0 ? R.string.view_down : R.string.view_up);
        return getContext().getString(R.string.view_attitude, Math.round(Math.abs(rollDeg)), bank,
                Math.round(Math.abs(pitchDeg)), nose);
    }

    @Override
    protected String name() {
        return getContext().getString(R.string.view_attitude_name);
    }

    private void drawBall(Canvas canvas) {
        InstrumentColors colors = colors();
        float far = FAR * Math.max(getWidth(), getHeight());
        canvas.save();
        canvas.rotate(geometry.ballRotationDeg());
        canvas.translate(0, geometry.ballShift());
        canvas.drawRect(-far, -far, far, 0, area(colors.sky));
        canvas.drawRect(-far, 0, far, far, area(colors.earth));
        canvas.drawLine(-far, 0, far, 0, line(colors.horizonInk, 2));
        for (int rung = 0; rung < labels.length; rung++) {
            if (geometry.isRungVisible(rung)) {
                drawRung(canvas, rung, colors);
            }
        }
        canvas.restore();
    }

    private void drawRung(Canvas canvas, int rung, InstrumentColors colors) {
        float y = geometry.rungY(rung);
        float half = geometry.rungHalfWidth(rung);
        canvas.drawLine(-half, y, half, y, line(colors.horizonInk, 1.5f));
        // Next to the aircraft's own symbol there is not enough room for a number.
        boolean isBesideWings = Math.abs(y + geometry.ballShift()) < dp(12);
        if (geometry.isLabelled(rung) && !isBesideWings) {
            before(canvas, labels[rung], -half - dp(4), y, 11, colors.horizonInk);
            after(canvas, labels[rung], half + dp(4), y, 11, colors.horizonInk);
        }
    }

    private void drawScale(Canvas canvas) {
        InstrumentColors colors = colors();
        float radius = geometry.radius();
        canvas.drawArc(arc, -150, 120, false, line(colors.horizonInk, 1.5f));
        for (int mark = 0; mark < geometry.rollMarkCount(); mark++) {
            float angle = geometry.rollMarkDeg(mark);
            float outer = radius + geometry.rollMarkLength(mark);
            canvas.drawLine(HorizonGeometry.circleX(angle, radius),
                    HorizonGeometry.circleY(angle, radius),
                    HorizonGeometry.circleX(angle, outer),
                    HorizonGeometry.circleY(angle, outer), pen);
        }
        canvas.drawPath(zero, area(colors.horizonInk));
        canvas.save();
        canvas.rotate(geometry.ballRotationDeg());
        canvas.drawPath(pointer, area(colors.horizonInk));
        canvas.restore();
    }

    private void drawAircraft(Canvas canvas) {
        float wing = geometry.radius() * 0.8f;
        float root = geometry.radius() * 0.38f;
        drawWings(canvas, wing, root, colors().ground, 6);
        drawWings(canvas, wing, root, colors().warning, 3);
        canvas.drawCircle(0, 0, dp(3.5f), area(colors().warning));
    }

    private void drawWings(Canvas canvas, float wing, float root, int colour, float widthDp) {
        line(colour, widthDp);
        canvas.drawLine(-wing, 0, -root, 0, pen);
        canvas.drawLine(-root, 0, -root, dp(8), pen);
        canvas.drawLine(root, 0, wing, 0, pen);
        canvas.drawLine(root, 0, root, dp(8), pen);
    }

    private void triangle(Path path, float tip, float base) {
        path.reset();
        path.moveTo(0, tip);
        path.lineTo(-dp(6), base);
        path.lineTo(dp(6), base);
        path.close();
    }
}
