package org.raspilot.app.view;

import android.content.Context;
import android.graphics.Canvas;
import android.graphics.ColorFilter;
import android.graphics.Paint;
import android.graphics.PixelFormat;
import android.graphics.Rect;
import android.graphics.drawable.Drawable;

/** A background of slanted lines behind stale values. Draws nothing until it is active. */
public final class Hatch extends Drawable {
    private static final float STEP_DP = 9;

    private final Paint pen = new Paint(Paint.ANTI_ALIAS_FLAG);
    private final float step;
    private boolean isActive;

    public Hatch(Context context, int colour) {
        float density = context.getResources().getDisplayMetrics().density;
        step = STEP_DP * density;
        pen.setColor(colour);
        pen.setStrokeWidth(1.5f * density);
    }

    public void setActive(boolean isNowActive) {
        if (isActive != isNowActive) {
            isActive = isNowActive;
            invalidateSelf();
        }
    }

    @Override
    public void draw(Canvas canvas) {
        if (!isActive) {
            return;
        }
        Rect box = getBounds();
        canvas.save();
        canvas.clipRect(box);
        for (float x = box.left; x < box.right + box.height(); x += step) {
            canvas.drawLine(x, box.top, x - box.height(), box.bottom, pen);
        }
        canvas.restore();
    }

    @Override
    public void setAlpha(int alpha) {
        pen.setAlpha(alpha);
    }

    @Override
    public void setColorFilter(ColorFilter filter) {
        pen.setColorFilter(filter);
    }

    @Override
    public int getOpacity() {
        return PixelFormat.TRANSLUCENT;
    }
}
