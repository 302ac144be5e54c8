package org.raspilot.app.view;

import android.content.Context;
import android.graphics.Canvas;
import android.util.AttributeSet;
import java.util.Arrays;
import org.raspilot.app.R;

/**
 * Six channels as bars of 1000 to 2000 us around their middle: the pilot's sticks or the servos.
 *
 * <p>A channel that is not known is an empty row of dashes.
 */
public final class BarsView extends Instrument {
    private static final int CHANNELS = 6;

    private final String[] names;
    private final double[] pulsesUs = new double[CHANNELS];
    private final String[] figures = new String[CHANNELS];
    private int shown = CHANNELS;
    private String title = "";

    /** Creates the view from a layout; its content description is the title. */
    public BarsView(Context context, AttributeSet attributes) {
        super(context, attributes);
        names = getResources().getStringArray(R.array.view_channels);
        Arrays.fill(pulsesUs, Double.NaN);
        Arrays.fill(figures, UNKNOWN);
    }

    /** Sets the text above the bars, and how many of the 6 channels they show. */
    public void setTitle(String text, int channels) {
        title = text;
        shown = Math.max(1, Math.min(CHANNELS, channels));
        requestLayout();
        invalidate();
    }

    /** Takes the pulse of a channel, 0 to 5, us; null: not known. */
    public void setChannel(int channel, Double pulseUs) {
        double pulse = pulseUs == null ? Double.NaN : pulseUs;
        if (Double.compare(pulse, pulsesUs[channel]) != 0) {
            pulsesUs[channel] = pulse;
            figures[channel] = pulseUs == null ? UNKNOWN : Long.toString(Math.round(pulse));
            invalidate();
        }
    }

    @Override
    protected void onMeasure(int widthSpec, int heightSpec) {
        int wanted = Math.round((shown + 1) * rowHeight());
        setMeasuredDimension(getDefaultSize(getSuggestedMinimumWidth(), widthSpec),
                resolveSize(Math.max(wanted, getSuggestedMinimumHeight()), heightSpec));
    }

    @Override
    protected void drawReadings(Canvas canvas) {
        float row = getHeight() / (shown + 1f);
        after(canvas, title, dp(4), row / 2, 12, colors().dim);
        for (int channel = 0; channel < shown; channel++) {
            drawChannel(canvas, channel, row * (channel + 1.5f), row);
        }
    }

    @Override
    protected void drawEmpty(Canvas canvas) {
        super.drawEmpty(canvas);
        after(canvas, title, dp(4), getHeight() / (shown + 1f) / 2, 12, colors().dim);
    }

    @Override
    protected String describe() {
        StringBuilder all = new StringBuilder(title);
        for (int channel = 0; channel < shown; channel++) {
            all.append(channel == 0 ? ": " : ", ");
            all.append(names[channel]).append(' ').append(figures[channel]);
        }
        return all.toString();
    }

    @Override
    protected String name() {
        return title;
    }

    private void drawChannel(Canvas canvas, int channel, float y, float row) {
        InstrumentColors colors = colors();
        float left = sp(62);
        float right = getWidth() - sp(38);
        float middle = (left + right) / 2;
        float half = (right - left) / 2;
        float thick = Math.min(row * 0.3f, dp(6));
        after(canvas, names[channel], dp(4), y, 12, colors.ink);
        before(canvas, figures[channel], getWidth() - dp(4), y, 12, colors.ink);
        canvas.drawRect(left, y - thick, right, y + thick, line(colors.line, 1));
        canvas.drawLine(middle, y - thick * 1.4f, middle, y + thick * 1.4f, pen);
        double pulse = pulsesUs[channel];
        if (Double.isNaN(pulse)) {
            return;
        }
        float at = middle + half / 1.1f * BarsGeometry.share(pulse);
        area(BarsGeometry.isBeyond(pulse) ? colors.warning : colors.accent);
        canvas.drawRect(Math.min(middle, at), y - thick, Math.max(middle, at), y + thick, pen);
    }

    private float rowHeight() {
        return Math.max(dp(20), sp(17));
    }
}
