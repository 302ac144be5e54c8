package org.raspilot.app.commands;

import android.content.Context;
import android.text.InputFilter;
import android.text.InputType;
import org.raspilot.app.view.TextListener;
import android.text.method.DigitsKeyListener;
import android.view.View;
import android.widget.AdapterView;
import android.widget.ArrayAdapter;
import android.widget.EditText;
import android.widget.Spinner;
import android.widget.Switch;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import org.raspilot.app.R;
import org.raspilot.up.commands.CommandField;
import org.raspilot.up.commands.FieldType;

/** The input of a field's value: a text, a choice or a switch. */
abstract class FieldInput {
    private static final int MAX_LENGTH = 4096;
    private static final String DIGITS = "0123456789.,-";

    static FieldInput of(Context context, CommandField field, Runnable onChange) {
        List<Object> choices = field.choices;
        if (choices == null && field.type == FieldType.BOOLEAN) {
            if (field.isRequired()) {
                return new SwitchInput(context, onChange);
            }
            choices = Arrays.<Object>asList("true", "false");
        }
        return choices == null ? new TextInput(context, field, onChange)
                : new ChoiceInput(context, choices, onChange);
    }

    final Runnable onChange;

    /** Takes what runs when text was typed or a choice made. */
    FieldInput(Runnable onChange) {
        this.onChange = onChange;
    }

    abstract View view();

    /** Returns the typed or chosen value, or an empty text. */
    abstract String text();

    /** Writes or chooses; what cannot be chosen chooses nothing. */
    abstract void setText(String text);

    private static final class TextInput extends FieldInput {
        private final EditText view;

        private TextInput(Context context, CommandField field, Runnable onChange) {
            super(onChange);
            view = new EditText(context);
            view.setInputType(inputType(field));
            if (field.type == FieldType.NUMBER) {
                // Some phones' keyboards for numbers have a comma only, which is refused otherwise.
                view.setKeyListener(DigitsKeyListener.getInstance(DIGITS));
                view.setRawInputType(inputType(field));
            }
            // The aircraft counts characters, this counts UTF-16 units: never split a pair.
            view.setFilters(new InputFilter[] {new InputFilter.LengthFilter(MAX_LENGTH)});
            view.addTextChangedListener((TextListener) text -> onChange.run());
        }

        @Override
        View view() {
            return view;
        }

        @Override
        String text() {
            return view.getText().toString();
        }

        @Override
        void setText(String text) {
            view.setText(text);
            view.setSelection(view.length());
        }

        private static int inputType(CommandField field) {
            boolean isSigned = field.minimum == null || field.minimum < 0;
            int sign = isSigned ? InputType.TYPE_NUMBER_FLAG_SIGNED : 0;
            switch (field.type) {
                case INTEGER:
                    return InputType.TYPE_CLASS_NUMBER | sign;
                case NUMBER:
                    return InputType.TYPE_CLASS_NUMBER | InputType.TYPE_NUMBER_FLAG_DECIMAL
                            | sign;
                case TEXT:
                    return InputType.TYPE_CLASS_TEXT | InputType.TYPE_TEXT_FLAG_CAP_SENTENCES;
                default:
                    return InputType.TYPE_CLASS_TEXT | InputType.TYPE_TEXT_FLAG_MULTI_LINE
                            | InputType.TYPE_TEXT_FLAG_NO_SUGGESTIONS;
            }
        }
    }

    private static final class ChoiceInput extends FieldInput
            implements AdapterView.OnItemSelectedListener {
        private final Spinner view;
        private final List<String> texts = new ArrayList<>();

        private ChoiceInput(Context context, List<Object> choices, Runnable onChange) {
            super(onChange);
            List<String> shown = new ArrayList<>();
            shown.add(context.getString(R.string.commands_choose));
            texts.add("");
            for (Object choice : choices) {
                texts.add(String.valueOf(choice));
                shown.add(String.valueOf(choice));
            }
            view = new Spinner(context);
            ArrayAdapter<String> adapter = new ArrayAdapter<>(context,
                    android.R.layout.simple_spinner_item, shown);
            adapter.setDropDownViewResource(android.R.layout.simple_spinner_dropdown_item);
            view.setAdapter(adapter);
            view.setOnItemSelectedListener(this);
        }

        @Override
        View view() {
            return view;
        }

        @Override
        String text() {
            int place = view.getSelectedItemPosition();
            return place < 0 ? "" : texts.get(place);
        }

        @Override
        void setText(String text) {
            view.setSelection(Math.max(0, texts.indexOf(text)));
        }

        @Override
        public void onItemSelected(AdapterView<?> parent, View item, int place, long id) {
            onChange.run();
        }

        @Override
        public void onNothingSelected(AdapterView<?> parent) {
            onChange.run();
        }
    }

    private static final class SwitchInput extends FieldInput {
        private final Switch view;

        private SwitchInput(Context context, Runnable onChange) {
            super(onChange);
            view = new Switch(context);
            view.setTextOn(context.getString(R.string.commands_yes));
            view.setTextOff(context.getString(R.string.commands_no));
            view.setOnCheckedChangeListener((button, isChecked) -> onChange.run());
        }

        @Override
        View view() {
            return view;
        }

        @Override
        String text() {
            return Boolean.toString(view.isChecked());
        }

        @Override
        void setText(String text) {
            view.setChecked(Boolean.parseBoolean(text));
        }
    }
}
