package org.raspilot.app.commands;

import android.app.Activity;
import android.content.Context;
import android.view.View;
import android.view.ViewGroup;
import android.widget.EditText;
import android.widget.ListView;
import android.widget.TextView;
import java.util.List;
import java.util.Map;
import org.raspilot.app.R;
import org.raspilot.app.ground.ControlPanel;
import org.raspilot.app.ground.FrameLine;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.app.view.FrameText;
import org.raspilot.app.view.TextListener;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.android.TelemetryService;
import org.raspilot.up.commands.BaseCommand;
import org.raspilot.up.commands.CommandForm;
import org.raspilot.up.commands.Commands;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.ground.CommandGate;
import org.raspilot.up.ground.CommandGate.DisabledReason;

/** The list of Commands and the page of the one that is open, while their views live. */
final class CommandsScreen {
    private final Activity activity;
    private final CommandsState memory;
    private final List<CommandForm> forms;
    private final FrameLine frame;
    private final ControlPanel seat;
    private final HistoryPanel history;
    private final Confirmation confirmation;
    private final CommandList list;
    private final View listBox;
    private final View pageBox;
    private final ViewGroup pagePlace;
    private final View back;
    private TelemetryService.Ground ground;
    private Page page;

    /** Finds all views and restores the open page; {@code fault}: the error of the catalogue. */
    CommandsScreen(Activity activity, View root, CommandsState memory, List<CommandForm> forms,
            String fault) {
        this.activity = activity;
        this.memory = memory;
        this.forms = forms;
        frame = new FrameLine((FrameText) root.findViewById(R.id.ground_frame));
        // If the ground screen is visible beside this one, the seat is there.
        seat = root.findViewById(R.id.control_line) == null ? null : new ControlPanel(root);
        history = new HistoryPanel(root, memory.history());
        confirmation = new Confirmation(activity);
        TextViews.showOrHide((TextView) root.findViewById(R.id.commands_fault), fault);
        listBox = root.findViewById(R.id.commands_list_box);
        pageBox = root.findViewById(R.id.commands_page_box);
        pagePlace = (ViewGroup) root.findViewById(R.id.commands_page);
        back = root.findViewById(R.id.commands_back);
        if (back != null) {
            back.setOnClickListener(pressed -> open(""));
        }
        list = new CommandList(this, forms);
        ListView view = (ListView) root.findViewById(R.id.commands_list);
        view.setAdapter(list);
        view.setOnItemClickListener((parent, row, place, id) -> open(list.form(place).name));
        EditText search = (EditText) root.findViewById(R.id.commands_search);
        search.setText(memory.search());
        search(memory.search());
        search.addTextChangedListener((TextListener) text -> search(text.toString()));
        open(memory.open());
    }

    /** Sets the ground; null: none. Frames seen of another ground do not count. */
    void setGround(TelemetryService.Ground newGround) {
        ground = newGround;
        frame.clear();
        if (seat != null) {
            seat.setGround(newGround);
        }
    }

    void showFrame() {
        frame.update(picture());
    }

    void show() {
        showFrame();
        if (seat != null) {
            seat.update(picture());
        }
        if (page != null) {
            page.update();
        }
        if (listBox.isShown()) {
            list.refresh();
        }
        history.update();
    }

    void dismiss() {
        confirmation.dismiss();
    }

    void close() {
        dismiss();
        setGround(null);
        frame.close();
        page = null;
        pagePlace.removeAllViews();
    }

    private void search(String words) {
        memory.setSearch(words);
        list.search(words);
    }

    Context context() {
        return activity;
    }

    GroundSnapshot picture() {
        return GroundSnapshot.of(ground);
    }

    /** Returns what remembers texts, history and gains. */
    CommandsState memory() {
        return memory;
    }

    /** Returns why a Command is not offered now. */
    DisabledReason objection(CommandForm form, Map<String, ?> data) {
        GroundSnapshot picture = picture();
        return CommandGate.objection(form, data, picture.status, picture.telemetry,
                picture.nowMs);
    }

    /** Returns the same as a sentence; empty: it is offered. */
    String objectionText(CommandForm form, Map<String, ?> data) {
        return CommandTexts.objection(activity.getResources(), objection(form, data), picture());
    }

    /** Sends a Command immediately, with the beacon of the frame that was drawn last. */
    void send(BaseCommand command, String words) {
        if (isThere(words)) {
            ground.send(command, frame.shownBeacon(), memory.sent(words));
        }
    }

    void requestGains() {
        String words = activity.getString(R.string.gains_ask_words);
        if (isThere(words)) {
            ground.requestGains(memory.sent(words));
        }
    }

    void setGains(GainSet set) {
        String words = activity.getString(R.string.gains_send_words);
        if (isThere(words)) {
            ground.setGains(set, frame.shownBeacon(), memory.sent(words));
        }
    }

    /** Sends the set of gains before. */
    void undoGains() {
        String words = activity.getString(R.string.gains_undo_words);
        if (isThere(words)) {
            ground.undoGains(frame.shownBeacon(), memory.sent(words));
        }
    }

    /** Shows a confirmation; does nothing when the user declines or the screen is closed. */
    void confirm(String title, String text, String yes, Runnable then) {
        confirmation.show(title, text, yes, null, then);
    }

    /** Opens the form of a Command; empty or unknown: none. */
    private void open(String name) {
        CommandForm form = formOf(name);
        dismiss();
        memory.setOpen(form == null ? "" : name);
        pagePlace.removeAllViews();
        page = form == null ? null : pageOf(form);
        if (page != null) {
            pagePlace.addView(page.element);
        }
        if (back != null) {
            listBox.setVisibility(page == null ? View.VISIBLE : View.GONE);
            pageBox.setVisibility(page == null ? View.GONE : View.VISIBLE);
        }
    }

    /** Returns whether there is a service to send with; if not, the history reports it. */
    private boolean isThere(String words) {
        if (ground == null) {
            memory.unsent(words, activity.getString(R.string.commands_no_service));
        }
        return ground != null;
    }

    private Page pageOf(CommandForm form) {
        if (form.name.equals("up.arm") || form.name.equals("up.disarm")) {
            return new ArmPage(formOf("up.arm"), formOf("up.disarm"), this);
        }
        if (form.name.equals("arduino.pids.tunings")) {
            return new GainsPage(form, this);
        }
        if (form.name.equals(Commands.FLIGHT_MODE)) {
            return new ModePage(form, this);
        }
        return new FormPage(form, this);
    }

    private CommandForm formOf(String name) {
        for (CommandForm form : forms) {
            if (form.name.equals(name)) {
                return form;
            }
        }
        return null;
    }
}
