package org.raspilot.app;

import android.app.AlertDialog;
import android.app.Dialog;
import android.app.DialogFragment;
import android.os.Bundle;
import org.raspilot.up.android.BaseUpService;

/** Shows a confirmation before an aeroplane in the air loses its phone. */
public final class StopDialog extends DialogFragment {
    static final String TAG = "stop question";

    @Override
    public Dialog onCreateDialog(Bundle saved) {
        return new AlertDialog.Builder(getActivity())
                .setMessage(R.string.stop_question)
                .setPositiveButton(R.string.stop_big, (dialog, button) ->
                        BaseUpService.stop(getActivity(), RaspilotUpService.class))
                .setNegativeButton(R.string.cancel, null)
                .create();
    }
}
