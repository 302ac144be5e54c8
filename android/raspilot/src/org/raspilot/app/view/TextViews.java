package org.raspilot.app.view;

import android.view.View;
import android.widget.TextView;

/** Writes texts into views only when they change: each change costs a layout. */
public final class TextViews {
    private TextViews() {
    }

    public static void show(TextView view, String text) {
        if (!text.contentEquals(view.getText())) {
            view.setText(text);
        }
    }

    /** Writes a text; the view is gone while the text is empty. */
    public static void showOrHide(TextView view, String text) {
        show(view, text);
        int visibility = text.isEmpty() ? View.GONE : View.VISIBLE;
        if (view.getVisibility() != visibility) {
            view.setVisibility(visibility);
        }
    }

    public static void colour(TextView view, int colour) {
        if (view.getCurrentTextColor() != colour) {
            view.setTextColor(colour);
        }
    }
}
