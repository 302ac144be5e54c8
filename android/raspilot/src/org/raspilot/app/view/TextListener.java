package org.raspilot.app.view;

import android.text.Editable;
import android.text.TextWatcher;

/** Called when a text was edited. */
public interface TextListener extends TextWatcher {
    @Override
    void afterTextChanged(Editable text);

    @Override
    default void beforeTextChanged(CharSequence text, int start, int count, int after) {
    }

    @Override
    default void onTextChanged(CharSequence text, int start, int before, int count) {
    }
}
