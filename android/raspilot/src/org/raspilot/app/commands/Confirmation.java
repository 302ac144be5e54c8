package org.raspilot.app.commands;

import android.app.AlertDialog;
import android.content.Context;
import android.view.View;
import org.raspilot.app.R;

/** A question before something is done; one at a time, and gone with the screen. */
public final class Confirmation {
    private final Context context;
    private AlertDialog dialog;

    public Confirmation(Context context) {
        this.context = context;
    }

    /**
     * Shows the dialog with an input below the text, or null; {@code then} runs only if confirmed.
     */
    public void show(String title, String text, String yes, View input, final Runnable then) {
        show(title, text, yes, input, then, null, null);
    }

    /**
     * Shows the dialog with a second choice, which runs {@code instead}; {@code other} null: none.
     */
    public void show(String title, String text, String yes, View input, final Runnable then,
            String other, final Runnable instead) {
        dismiss();
        dialog = new AlertDialog.Builder(context)
                .setTitle(title)
                .setMessage(text)
                .setView(input)
                .setNegativeButton(R.string.commands_leave, null)
                .setNeutralButton(other, (asked, which) -> instead.run())
                .setPositiveButton(yes, (asked, which) -> then.run())
                .create();
        dialog.show();
    }

    /** Takes the question back; nothing is done. */
    public void dismiss() {
        if (dialog != null) {
            dialog.dismiss();
            dialog = null;
        }
    }
}
