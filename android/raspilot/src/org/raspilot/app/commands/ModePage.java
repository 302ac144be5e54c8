package org.raspilot.app.commands;

import android.content.res.Resources;
import android.view.LayoutInflater;
import android.view.ViewGroup;
import android.widget.Button;
import android.widget.TextView;
import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.app.R;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandForm;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.ground.FlightModes;

/** A button for each flight mode that the aircraft reports; others show why they are not offered. */
final class ModePage extends Page {
    private final CommandForm form;
    private final ViewGroup list;
    private final TextView why;
    private final TextView now;
    private final Map<String, Button> buttons = new LinkedHashMap<>();

    /** Creates the page of {@code up.flight_mode.set}. */
    ModePage(CommandForm form, CommandsScreen desk) {
        super(desk, R.layout.page_modes);
        this.form = form;
        text(R.id.page_title).setText(CommandTexts.title(form.name));
        list = (ViewGroup) element.findViewById(R.id.modes_list);
        why = text(R.id.modes_why);
        now = text(R.id.modes_now);
        update();
    }

    @Override
    void update() {
        Resources words = desk.context().getResources();
        String objection = desk.objectionText(form, Collections.emptyMap());
        TextViews.showOrHide(why, objection);
        TextViews.showOrHide(now, CommandTexts.now(words, form.name, desk.picture()));
        Map<String, String> modes = FlightModes.all(desk.picture().telemetry);
        if (!new ArrayList<>(modes.keySet()).equals(new ArrayList<>(buttons.keySet()))) {
            rebuild(modes);
        }
        for (Map.Entry<String, String> mode : modes.entrySet()) {
            Button button = buttons.get(mode.getKey());
            String code = mode.getValue();
            TextViews.show(button, CommandTexts.mode(words, mode.getKey(), code));
            button.setEnabled(code == null && objection.isEmpty());
        }
    }

    private void rebuild(Map<String, String> modes) {
        list.removeAllViews();
        buttons.clear();
        LayoutInflater inflater = LayoutInflater.from(desk.context());
        for (final String mode : modes.keySet()) {
            Button button = (Button) inflater.inflate(R.layout.button_choice, list, false);
            button.setOnClickListener(pressed -> confirm(mode));
            list.addView(button);
            buttons.put(mode, button);
        }
    }

    private void confirm(String mode) {
        BaseCommand command = Commands.flightMode(mode);
        confirm(command, CommandTexts.asked(form.name, command.data()));
    }
}
