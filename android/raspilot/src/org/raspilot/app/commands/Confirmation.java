package org.raspilot.app.commands;

import android.app.AlertDialog;
import android.content.Context;
import org.raspilot.app.R;

/** A question before something is done; one at a time, and gone with the screen. */
final class Confirmation {
    private final Context context;
    private AlertDialog dialog;

    /** Makes it for an activity's context. */
    Confirmation(Context context) {
        this.context = context;
    }

    /** Shows the dialog; {@code then} runs only when the user confirms. */
    void show(String title, String text, String yes, final Runnable then) {
        dismiss();
        dialog = new AlertDialog.Builder(context)
                .setTitle(title)
                .setMessage(text)
                .setNegativeButton(R.string.commands_leave, null)
                .setPositiveButton(yes, (asked, which) -> then.run())
                .create();
        dialog.show();
    }

    /** Takes the question back; nothing is done. */
    void dismiss() {
        if (dialog != null) {
            dialog.dismiss();
            dialog = null;
        }
    }
}
