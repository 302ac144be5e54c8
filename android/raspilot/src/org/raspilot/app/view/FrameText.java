package org.raspilot.app.view;

import android.content.Context;
import android.graphics.Canvas;
import android.util.AttributeSet;
import android.widget.TextView;

/**
 * Shows a frame of telemetry in a line, and reports when that line was really drawn.
 *
 * <p>A Command echoes the beacon of the newest frame that its sender has seen; a hidden or hanging
 * screen draws nothing, and so sees nothing.
 */
public final class FrameText extends TextView {
    /** Called when a frame was drawn; main thread, while drawing: it must not change views. */
    public interface DrawnListener {
        /** Takes the beacon of the frame that was drawn. */
        void onDrawn(Long beacon);
    }

    private DrawnListener listener;
    private Long waiting;

    public FrameText(Context context, AttributeSet attributes) {
        super(context, attributes);
    }

    /** Sets the only listener; null: none. */
    public void setDrawnListener(DrawnListener newListener) {
        listener = newListener;
    }

    /** Takes a text and the beacon of the frame that it shows; null: none. */
    public void setFrame(CharSequence text, Long beacon) {
        if (!text.toString().contentEquals(getText())) {
            setText(text);
        }
        waiting = beacon;
        if (beacon != null) {
            // The same text of another frame is another drawing.
            invalidate();
        }
    }

    @Override
    protected void onDraw(Canvas canvas) {
        super.onDraw(canvas);
        Long drawn = waiting;
        waiting = null;
        if (drawn != null && listener != null) {
            listener.onDrawn(drawn);
        }
    }
}
