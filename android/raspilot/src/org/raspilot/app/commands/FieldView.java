package org.raspilot.app.commands;

import android.content.Context;
import android.content.res.Resources;
import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import android.widget.TextView;
import java.util.Map;
import org.raspilot.app.R;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.commands.CommandField;
import org.raspilot.up.commands.FieldType;
import org.raspilot.up.commands.InvalidCommandException;

/** One field of a form: its label, its input, its rule, its error. */
final class FieldView {
    private final CommandField field;
    private final Map<String, String> draft;
    private final View element;
    private final FieldInput input;
    private final TextView problem;
    private boolean isReady;

    /** Adds the field at the end of a form; {@code draft} stores its value. */
    FieldView(ViewGroup form, CommandField field, Map<String, String> draft) {
        this.field = field;
        this.draft = draft;
        Context context = form.getContext();
        element = LayoutInflater.from(context).inflate(R.layout.row_field, form, false);
        form.addView(element);
        problem = (TextView) element.findViewById(R.id.field_problem);
        input = FieldInput.of(context, field, () -> onChange());
        View view = input.view();
        view.setMinimumHeight(context.getResources().getDimensionPixelSize(R.dimen.touch_least));
        view.setContentDescription(label(context.getResources()));
        ((ViewGroup) element.findViewById(R.id.field_input)).addView(view);
        ((TextView) element.findViewById(R.id.field_label)).setText(label(context.getResources()));
        ((TextView) element.findViewById(R.id.field_hint)).setText(field.text);
        String kept = draft.get(field.name);
        if (kept != null) {
            input.setText(kept);
        }
        if (!input.text().isEmpty()) {
            // A switch has a value from the start.
            draft.put(field.name, input.text());
        }
        isReady = true;
    }

    /** Writes a value, as a preset does. */
    void setText(String text) {
        input.setText(text);
    }

    /** Shows the error of the value; returns whether it is valid. */
    boolean validate() {
        String sentence = sentence(input.text());
        show(sentence);
        return sentence.isEmpty();
    }

    void focus() {
        input.view().requestFocus();
    }

    private void onChange() {
        String text = input.text();
        draft.put(field.name, text);
        if (isReady) {
            // An empty, untouched field shows no error.
            show(text.trim().isEmpty() ? "" : sentence(text));
        }
    }

    private String sentence(String text) {
        if (text.trim().isEmpty()) {
            return field.isRequired()
                    ? element.getResources().getString(R.string.field_missing) : "";
        }
        try {
            field.parse(text);
            return "";
        } catch (InvalidCommandException wrong) {
            return wrong.getMessage();
        }
    }

    private void show(String sentence) {
        TextViews.showOrHide(problem, sentence);
    }

    private String label(Resources words) {
        String name = field.unit.isEmpty() ? field.name
                : words.getString(R.string.field_unit, field.name, field.unit);
        boolean isSwitch = field.type == FieldType.BOOLEAN && field.isRequired();
        return field.isRequired() || isSwitch ? name
                : words.getString(R.string.field_optional, name);
    }
}
