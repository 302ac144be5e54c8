package org.raspilot.app.view;

import android.content.Context;
import android.graphics.Canvas;
import android.graphics.Paint;
import android.graphics.Typeface;
import android.util.AttributeSet;
import android.view.View;
import android.view.accessibility.AccessibilityEvent;
import android.view.accessibility.AccessibilityNodeInfo;
import org.raspilot.app.R;
import org.raspilot.up.ground.Freshness;

/**
 * Shows readings of the aircraft, and never shows a stale one as current.
 *
 * <p>A stale reading is grey and hatched with its age on top; an unknown one is dashes. Drawing
 * allocates nothing: texts are created when their values change. Main thread only.
 */
public abstract class Instrument extends View {
    public static final String UNKNOWN = "--";

    /** For lines and areas; a drawing sets what it needs. */
    protected final Paint pen = new Paint(Paint.ANTI_ALIAS_FLAG);
    /** For letters; a drawing sets what it needs. */
    protected final Paint letters = new Paint(Paint.ANTI_ALIAS_FLAG);

    private final float density;
    private final float scaledDensity;
    private final InstrumentColors liveColors;
    private final InstrumentColors staleColors;
    private Freshness freshness = Freshness.NONE;
    private String age = "";
    private final Hatch hatch;

    protected Instrument(Context context, AttributeSet attributes) {
        super(context, attributes);
        density = getResources().getDisplayMetrics().density;
        scaledDensity = getResources().getDisplayMetrics().scaledDensity;
        liveColors = InstrumentColors.of(context);
        staleColors = liveColors.stale();
        hatch = new Hatch(context, liveColors.hatch);
        hatch.setActive(true);
        letters.setTypeface(Typeface.DEFAULT_BOLD);
        if (getImportantForAccessibility() == IMPORTANT_FOR_ACCESSIBILITY_AUTO) {
            setImportantForAccessibility(IMPORTANT_FOR_ACCESSIBILITY_YES);
        }
    }

    /** Takes the freshness of the readings, and their age in words. */
    public final void setFreshness(Freshness now, String ageText) {
        String shown = now == Freshness.STALE ? ageText : "";
        if (now != freshness || !shown.equals(age)) {
            freshness = now;
            age = shown;
            invalidate();
        }
    }

    public final Freshness freshness() {
        return freshness;
    }

    /** Draws the readings; called only while something is known. */
    protected abstract void drawReadings(Canvas canvas);

    /** Draws the parts without readings: the frame of the instrument. */
    protected void drawEmpty(Canvas canvas) {
        centred(canvas, UNKNOWN, getWidth() / 2f, getHeight() / 2f, 24, colors().dim);
    }

    /** Returns the readings in words for screen readers, without their age. */
    protected abstract String describe();

    /** Returns the current colours: greys where the reading is stale. */
    protected final InstrumentColors colors() {
        return freshness == Freshness.LIVE ? liveColors : staleColors;
    }

    /** Converts density-independent pixels to pixels. */
    protected final float dp(float count) {
        return count * density;
    }

    /** Converts scaled text pixels to pixels. */
    protected final float sp(float count) {
        return count * scaledDensity;
    }

    @Override
    protected final void onDraw(Canvas canvas) {
        canvas.drawColor(liveColors.ground);
        if (freshness == Freshness.NONE) {
            drawEmpty(canvas);
            return;
        }
        drawReadings(canvas);
        if (freshness == Freshness.STALE) {
            drawAge(canvas);
        }
    }

    @Override
    protected void onSizeChanged(int width, int height, int oldWidth, int oldHeight) {
        super.onSizeChanged(width, height, oldWidth, oldHeight);
        hatch.setBounds(0, 0, width, height);
    }

    @Override
    public final CharSequence getContentDescription() {
        switch (freshness) {
            case LIVE:
                return describe();
            case STALE:
                return getContext().getString(R.string.view_old, describe(), age);
            default:
                return getContext().getString(R.string.view_unknown, name());
        }
    }

    protected abstract String name();

    @Override
    public void onInitializeAccessibilityNodeInfo(AccessibilityNodeInfo info) {
        super.onInitializeAccessibilityNodeInfo(info);
        // Some versions read the field behind getContentDescription().
        info.setContentDescription(getContentDescription());
    }

    @Override
    public void onPopulateAccessibilityEvent(AccessibilityEvent event) {
        super.onPopulateAccessibilityEvent(event);
        event.getText().add(getContentDescription());
    }

    /** Returns the position of the age, as a share of the width, clear of the readings. */
    protected float ageAcross() {
        return 0.5f;
    }

    /** Returns whether the age is at the upper edge instead of the lower one. */
    protected boolean isAgeAbove() {
        return false;
    }

    /** Draws letters around a point; the size in sp. */
    protected final void centred(Canvas canvas, String text, float x, float y, float sizeSp,
            int colour) {
        letters.setTextAlign(Paint.Align.CENTER);
        written(canvas, text, x, y, sizeSp, colour);
    }

    /** Draws text that starts at a point, vertically centred on it; the size in sp. */
    protected final void after(Canvas canvas, String text, float x, float y, float sizeSp,
            int colour) {
        letters.setTextAlign(Paint.Align.LEFT);
        written(canvas, text, x, y, sizeSp, colour);
    }

    /** Draws letters that end at a point, their middle at its height; the size in sp. */
    protected final void before(Canvas canvas, String text, float x, float y, float sizeSp,
            int colour) {
        letters.setTextAlign(Paint.Align.RIGHT);
        written(canvas, text, x, y, sizeSp, colour);
    }

    /** Makes the pen draw lines; the width in dp. */
    protected final Paint line(int colour, float widthDp) {
        pen.setStyle(Paint.Style.STROKE);
        pen.setStrokeWidth(dp(widthDp));
        pen.setColor(colour);
        return pen;
    }

    protected final Paint area(int colour) {
        pen.setStyle(Paint.Style.FILL);
        pen.setColor(colour);
        return pen;
    }

    private void written(Canvas canvas, String text, float x, float y, float sizeSp, int colour) {
        letters.setTextSize(sp(sizeSp));
        letters.setColor(colour);
        float middle = (letters.ascent() + letters.descent()) / 2;
        canvas.drawText(text, x, y - middle, letters);
    }

    private void drawAge(Canvas canvas) {
        hatch.draw(canvas);
        float size = sp(13);
        float wide = Math.min(getWidth(), letterWidth(age, 13) + dp(8));
        float x = Math.max(wide / 2, getWidth() * ageAcross());
        float y = isAgeAbove() ? size : getHeight() - size;
        canvas.drawRect(x - wide / 2, y - size * 0.8f, x + wide / 2, y + size * 0.8f,
                area(liveColors.ground));
        centred(canvas, age, x, y, 13, liveColors.warning);
    }

    /** Returns how wide letters are, pixels; the size in sp. */
    protected final float letterWidth(String text, float sizeSp) {
        letters.setTextSize(sp(sizeSp));
        return letters.measureText(text);
    }
}
