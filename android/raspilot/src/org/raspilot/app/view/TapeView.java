package org.raspilot.app.view;

import android.content.Context;
import android.content.res.TypedArray;
import android.graphics.Canvas;
import android.graphics.Path;
import android.util.AttributeSet;
import org.raspilot.app.R;
import org.raspilot.up.ground.Freshness;

/** A tape of numbers behind a window that shows the value itself: speed, altitude. */
public final class TapeView extends Instrument {
    private static final float MARK_DP = 14;
    private static final float WINDOW_DP = 15;

    private final TapeGeometry geometry;
    private final String title;
    private final String unit;
    private final int labelEach;
    private final boolean isLeft;
    private final boolean hasMinimum;
    private final Path window = new Path();
    private String[] labels = new String[0];
    private long labelledFrom = Long.MIN_VALUE;
    private float value;
    private String valueText = UNKNOWN;

    public TapeView(Context context, AttributeSet attributes) {
        super(context, attributes);
        TypedArray has = context.obtainStyledAttributes(attributes, R.styleable.TapeView);
        try {
            title = textOf(has, R.styleable.TapeView_tapeTitle);
            unit = textOf(has, R.styleable.TapeView_tapeUnit);
            geometry = new TapeGeometry(has.getFloat(R.styleable.TapeView_tapeStep, 1));
            labelEach = Math.max(1, has.getInt(R.styleable.TapeView_tapeLabelEach, 5));
            isLeft = has.getBoolean(R.styleable.TapeView_tapeIsLeft, true);
            hasMinimum = has.getBoolean(R.styleable.TapeView_tapeHasLeast, false);
        } finally {
            has.recycle();
        }
    }

    /** Takes a value, in the tape's unit. */
    public void setValue(double now) {
        if ((float) now == value && valueText != UNKNOWN) {
            return;
        }
        value = (float) now;
        valueText = Long.toString(Math.round(now));
        label();
        invalidate();
    }

    @Override
    protected void onSizeChanged(int width, int height, int oldWidth, int oldHeight) {
        super.onSizeChanged(width, height, oldWidth, oldHeight);
        geometry.resize(height, dp(MARK_DP));
        labels = new String[geometry.count()];
        labelledFrom = Long.MIN_VALUE;
        label();
        float half = dp(WINDOW_DP);
        float edge = isLeft ? width : 0;
        float back = isLeft ? width - dp(7) : dp(7);
        float far = isLeft ? 0 : width;
        window.reset();
        window.moveTo(far, -half);
        window.lineTo(back, -half);
        window.lineTo(edge, 0);
        window.lineTo(back, half);
        window.lineTo(far, half);
        window.close();
    }

    @Override
    protected void drawReadings(Canvas canvas) {
        canvas.save();
        canvas.translate(0, getHeight() / 2f);
        geometry.show(value);
        for (int place = 0; place < labels.length; place++) {
            drawMark(canvas, place);
        }
        canvas.drawPath(window, area(colors().ground));
        canvas.drawPath(window, line(colors().ink, 1.5f));
        centred(canvas, valueText, getWidth() / 2f, 0, 18, colors().ink);
        canvas.restore();
        drawCaps(canvas);
    }

    @Override
    protected void drawEmpty(Canvas canvas) {
        super.drawEmpty(canvas);
        drawCaps(canvas);
    }

    @Override
    protected String describe() {
        return getContext().getString(R.string.view_tape, title, valueText, unit);
    }

    @Override
    protected String name() {
        return title;
    }

    private void drawMark(Canvas canvas, int place) {
        if (labels[place] == null) {
            return;
        }
        float y = geometry.y(place);
        // Whole or not at all: the caps at both ends must not cut a number in two.
        boolean isWhole = Math.abs(y) < getHeight() / 2f - capHeight() - sp(6);
        boolean isLabelled = labels[place].length() > 0 && isWhole;
        float length = dp(isLabelled ? 8 : 4);
        float edge = isLeft ? getWidth() : 0;
        float inner = isLeft ? edge - length : length;
        canvas.drawLine(edge, y, inner, y, line(colors().dim, 1.5f));
        if (!isLabelled) {
            return;
        }
        if (isLeft) {
            before(canvas, labels[place], inner - dp(3), y, 12, colors().dim);
        } else {
            after(canvas, labels[place], inner + dp(3), y, 12, colors().dim);
        }
    }

    private void drawCaps(Canvas canvas) {
        float high = capHeight();
        float middle = getWidth() / 2f;
        canvas.drawRect(0, 0, getWidth(), high, area(colors().ground));
        centred(canvas, title, middle, high / 2, 11, colors().dim);
        if (freshness() == Freshness.STALE) {
            return;
        }
        float foot = getHeight() - high;
        canvas.drawRect(0, foot, getWidth(), getHeight(), area(colors().ground));
        centred(canvas, unit, middle, foot + high / 2, 11, colors().dim);
    }

    private float capHeight() {
        return sp(11) * 1.5f;
    }

    /** Rebuilds the labels when the tape has moved by a whole mark. */
    private void label() {
        geometry.show(value);
        if (geometry.firstMark() == labelledFrom) {
            return;
        }
        labelledFrom = geometry.firstMark();
        for (int place = 0; place < labels.length; place++) {
            labels[place] = labelOf(place);
        }
    }

    private String labelOf(int place) {
        if (hasMinimum && geometry.value(place) < 0) {
            return null;
        }
        return geometry.isEach(place, labelEach)
                ? Integer.toString(Math.round(geometry.value(place))) : "";
    }

    private static String textOf(TypedArray has, int which) {
        String text = has.getString(which);
        return text == null ? "" : text;
    }
}
