package org.raspilot.app.commands;

import android.content.Context;
import android.content.res.Resources;
import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import android.widget.Button;
import android.widget.TextView;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import org.raspilot.app.R;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandField;
import org.raspilot.up.commands.CommandForm;

/** A Command whose one field is a choice of few values: a button for each, with a confirmation. */
final class ChoicePage implements Page {
    private static final int MAX_CHOICES = 6;

    private final CommandForm form;
    private final CommandContext desk;
    private final View element;
    private final TextView why;
    private final TextView now;
    private final List<Button> buttons = new ArrayList<>();

    /** Returns whether a form is of that kind. */
    static boolean fits(CommandForm form) {
        if (form.fields().size() != 1) {
            return false;
        }
        CommandField field = form.fields().get(0);
        return field.isRequired() && field.choices != null && field.choices.size() <= MAX_CHOICES;
    }

    ChoicePage(CommandForm form, CommandContext desk) {
        this.form = form;
        this.desk = desk;
        LayoutInflater inflater = LayoutInflater.from(desk.context());
        element = inflater.inflate(R.layout.page_form, null);
        Resources words = desk.context().getResources();
        ((TextView) element.findViewById(R.id.page_title))
                .setText(CommandTexts.title(words, form.name));
        ((TextView) element.findViewById(R.id.page_name)).setText(form.name);
        ((TextView) element.findViewById(R.id.page_text)).setText(form.text);
        why = (TextView) element.findViewById(R.id.page_why);
        now = (TextView) element.findViewById(R.id.page_now);
        element.findViewById(R.id.page_send).setVisibility(View.GONE);
        ViewGroup list = (ViewGroup) element.findViewById(R.id.page_fields);
        CommandField field = form.fields().get(0);
        for (Object choice : field.choices) {
            Button button = (Button) inflater.inflate(R.layout.button_choice, list, false);
            button.setText(String.valueOf(choice).replace('_', ' '));
            button.setOnClickListener(new Choose(Collections.singletonMap(field.name, choice)));
            list.addView(button);
            buttons.add(button);
        }
        update();
    }

    @Override
    public View element() {
        return element;
    }

    @Override
    public void update() {
        String objection = desk.objectionText(form, Collections.emptyMap());
        TextViews.showOrHide(why, objection);
        TextViews.showOrHide(now, CommandTexts.now(desk.context().getResources(), form.name,
                desk.picture()));
        for (Button button : buttons) {
            button.setEnabled(objection.isEmpty());
        }
    }

    private final class Choose implements View.OnClickListener, Runnable {
        private final BaseCommand command;
        private final String words;

        private Choose(Map<String, ?> data) {
            command = new BaseCommand(form.name, data);
            words = CommandTexts.asked(desk.context().getResources(), form.name, data);
        }

        @Override
        public void onClick(View button) {
            Context context = desk.context();
            desk.confirm(context.getString(R.string.commands_send_question), words,
                    context.getString(R.string.commands_send), this);
        }

        @Override
        public void run() {
            desk.send(command, words);
        }
    }
}
