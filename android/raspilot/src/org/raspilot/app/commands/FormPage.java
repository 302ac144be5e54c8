package org.raspilot.app.commands;

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
import org.raspilot.up.commands.InvalidCommandException;

/**
 * The form of any Command, made from its description. A Command whose one field is a choice of few
 * values has a button for each, with a confirmation.
 */
final class FormPage extends Page {
    private static final int[] PERIODS_MS = {50, 100, 200, 500, 1000, 2000};
    private static final int MAX_CHOICES = 6;

    private final CommandForm form;
    private final Map<String, String> draft;
    private final List<FieldView> fields = new ArrayList<>();
    private final List<View> buttons = new ArrayList<>();
    private final TextView why;
    private final TextView now;
    private final TextView problem;
    private final Button send;

    FormPage(CommandForm form, CommandsScreen desk) {
        super(desk, R.layout.page_form);
        this.form = form;
        draft = desk.memory().draft(form.name);
        text(R.id.page_title).setText(CommandTexts.title(form.name));
        text(R.id.page_name).setText(form.name);
        text(R.id.page_text).setText(form.text);
        why = text(R.id.page_why);
        now = text(R.id.page_now);
        problem = text(R.id.page_problem);
        send = (Button) element.findViewById(R.id.page_send);
        send.setOnClickListener(pressed -> validate());
        ViewGroup list = (ViewGroup) element.findViewById(R.id.page_fields);
        if (isChoice(form)) {
            addChoices(list, form.fields().get(0));
        } else {
            for (CommandField field : form.fields()) {
                fields.add(new FieldView(list, field, draft));
            }
        }
        if (form.name.equals("up.telemetry.frequency") && fields.size() == 1) {
            addPresets((ViewGroup) element.findViewById(R.id.page_presets));
        }
        update();
    }

    @Override
    void update() {
        Resources words = desk.context().getResources();
        String objection = desk.objectionText(form, Collections.emptyMap());
        TextViews.showOrHide(why, objection);
        TextViews.showOrHide(now, CommandTexts.now(words, form.name, desk.picture()));
        boolean isOffered = objection.isEmpty();
        send.setEnabled(isOffered);
        for (View button : buttons) {
            button.setEnabled(isOffered);
        }
    }

    private void validate() {
        TextViews.showOrHide(problem, "");
        boolean isRight = true;
        for (FieldView field : fields) {
            boolean isFieldRight = field.validate();
            if (isRight && !isFieldRight) {
                field.focus();
            }
            isRight &= isFieldRight;
        }
        if (isRight) {
            ask();
        }
    }

    private void ask() {
        BaseCommand command;
        try {
            command = form.command(draft);
        } catch (InvalidCommandException wrong) {
            TextViews.showOrHide(problem, wrong.getMessage());
            return;
        }
        String words = CommandTexts.asked(form.name, command.data());
        if (CommandGroup.isConfirmed(form, command.data())) {
            confirm(command, words);
        } else {
            desk.send(command, words);
        }
    }

    private static boolean isChoice(CommandForm form) {
        if (form.fields().size() != 1) {
            return false;
        }
        CommandField field = form.fields().get(0);
        return field.isRequired() && field.choices != null && field.choices.size() <= MAX_CHOICES;
    }

    private void addChoices(ViewGroup list, CommandField field) {
        send.setVisibility(View.GONE);
        LayoutInflater inflater = LayoutInflater.from(desk.context());
        for (Object choice : field.choices) {
            Button button = (Button) inflater.inflate(R.layout.button_choice, list, false);
            button.setText(String.valueOf(choice).replace('_', ' '));
            BaseCommand command = new BaseCommand(form.name,
                    Collections.singletonMap(field.name, choice));
            String words = CommandTexts.asked(form.name, command.data());
            button.setOnClickListener(pressed -> confirm(command, words));
            list.addView(button);
            buttons.add(button);
        }
    }

    private void addPresets(ViewGroup row) {
        LayoutInflater inflater = LayoutInflater.from(desk.context());
        for (final int periodMs : PERIODS_MS) {
            Button preset = (Button) inflater.inflate(R.layout.button_preset, row, false);
            preset.setText(desk.context().getString(R.string.commands_preset, periodMs));
            preset.setOnClickListener(button -> fields.get(0).setText(Integer.toString(periodMs)));
            row.addView(preset);
            buttons.add(preset);
        }
        row.setVisibility(View.VISIBLE);
    }
}
