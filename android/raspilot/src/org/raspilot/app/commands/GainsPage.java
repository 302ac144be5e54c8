package org.raspilot.app.commands;

import android.content.Context;
import android.text.TextUtils;
import android.view.View;
import android.widget.Button;
import android.widget.TextView;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import org.raspilot.app.R;
import org.raspilot.app.ground.ControlPanel;
import org.raspilot.up.android.GroundSnapshot;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.commands.CommandForm;
import org.raspilot.up.commands.GainSet;
import org.raspilot.up.commands.InvalidCommandException;
import org.raspilot.up.ground.Age;
import org.raspilot.up.ground.Freshness;
import org.raspilot.up.ground.GainKey;
import org.raspilot.up.ground.GainsService.GainChange;
import org.raspilot.up.ground.GainsService.GainsEntry;
import org.raspilot.up.ground.GainsService;

/** The gains of every axis: active values, edits, their differences, and undo. */
final class GainsPage extends Page {
    private static final Map<String, Object> SET = Collections.emptyMap();
    private static final Map<String, Object> REQUEST =
            Collections.singletonMap("request", true);

    private final CommandForm form;
    private final GainsEditor editor;
    private final GainsTable table;
    private final TextView why;
    private final TextView state;
    private final TextView problem;
    private final TextView difference;
    private final TextView past;
    private final Button ask;
    private final Button undo;
    private final Button discard;
    private final Button send;
    private GainsService.Snapshot shown;

    GainsPage(CommandForm form, CommandsScreen desk) {
        super(desk, R.layout.page_gains);
        this.form = form;
        editor = desk.memory().gains();
        text(R.id.page_title).setText(CommandTexts.title(form.name));
        why = text(R.id.gains_why);
        state = text(R.id.gains_state);
        problem = text(R.id.gains_problem);
        difference = text(R.id.gains_difference);
        past = text(R.id.gains_past);
        ask = button(R.id.gains_ask, pressed -> desk.requestGains());
        undo = button(R.id.gains_undo, pressed -> confirmUndo());
        discard = button(R.id.gains_discard, pressed -> discard());
        send = button(R.id.gains_send, pressed -> confirmSend());
        updateActive();
        table = new GainsTable(element, editor, () -> update());
        update();
    }

    @Override
    void update() {
        updateActive();
        String objection = desk.objectionText(form, SET);
        boolean isOffered = objection.isEmpty();
        TextViews.showOrHide(why, isOffered ? warning() : objection);
        TextViews.show(state, stateText());
        table.update(isOffered && editor.flying() != null);
        String wrong = wrong();
        TextViews.showOrHide(problem, editor.hasEdits() ? wrong : "");
        TextViews.showOrHide(difference, differenceText());
        ask.setEnabled(desk.objectionText(form, REQUEST).isEmpty());
        send.setEnabled(isOffered && editor.hasEdits() && wrong.isEmpty());
        discard.setEnabled(editor.hasEdits());
        undo.setEnabled(isOffered && shown != null && shown.undo != null);
        TextViews.showOrHide(past, pastText());
    }

    private void discard() {
        editor.discard();
        table.refill();
        update();
    }

    private void updateActive() {
        GainsService.Snapshot newest = desk.picture().gains;
        if (newest != shown) {
            shown = newest;
            editor.setActive(newest == null ? null : newest.flying);
            if (table != null) {
                table.refill();
            }
        }
    }

    private void confirmSend() {
        final GainSet wanted;
        try {
            wanted = editor.wanted();
        } catch (InvalidCommandException wrong) {
            TextViews.showOrHide(problem, ControlPanel.sentence(wrong.getMessage()));
            return;
        }
        Context context = desk.context();
        String text = joined(differenceText(), warning());
        desk.confirm(context.getString(R.string.gains_question), text,
                context.getString(R.string.commands_send), () -> {
                    editor.accept();
                    desk.setGains(wanted);
                });
    }

    private void confirmUndo() {
        if (shown == null || shown.undo == null) {
            return;
        }
        Context context = desk.context();
        String changes = lines(GainsService.difference(shown.flying, shown.undo));
        desk.confirm(context.getString(R.string.gains_undo_question), joined(changes, warning()),
                context.getString(R.string.gains_undo), () -> desk.undoGains());
    }

    private String stateText() {
        Context context = desk.context();
        if (shown == null || shown.flying == null || shown.reportedMs == null) {
            return context.getString(R.string.gains_unknown);
        }
        return context.getString(R.string.gains_told,
                Age.agoText(desk.picture().nowMs - shown.reportedMs));
    }

    private String warning() {
        GroundSnapshot picture = desk.picture();
        boolean isLive = picture.telemetry.freshness("armed", picture.nowMs) == Freshness.LIVE;
        boolean isArmed = isLive && Boolean.TRUE.equals(picture.telemetry.flag("armed"));
        return isArmed ? desk.context().getString(R.string.gains_armed) : "";
    }

    private String wrong() {
        try {
            editor.wanted();
            return "";
        } catch (InvalidCommandException wrong) {
            return ControlPanel.sentence(wrong.getMessage());
        }
    }

    private String differenceText() {
        StringBuilder all = new StringBuilder(lines(editor.changes()));
        for (GainKey key : editor.conflicts()) {
            all.append(all.length() == 0 ? "" : "\n");
            all.append(desk.context().getString(R.string.gains_conflict, key.words(),
                    GainsEditor.text(key.of(editor.flying())), editor.seenText(key)));
        }
        return all.toString();
    }

    private String pastText() {
        if (shown == null) {
            return "";
        }
        StringBuilder all = new StringBuilder();
        List<GainsEntry> history = shown.history;
        for (int each = history.size() - 1; each >= 0; each--) {
            GainsEntry entry = history.get(each);
            all.append(all.length() == 0 ? "" : "\n");
            all.append(desk.context().getString(R.string.gains_entry, entry.number,
                    entry.answer.sentence(), lines(entry.changes()).replace("\n", "; ")));
        }
        return all.toString();
    }

    private Button button(int id, View.OnClickListener pressed) {
        Button found = (Button) element.findViewById(id);
        found.setOnClickListener(pressed);
        return found;
    }

    private static String lines(List<GainChange> changes) {
        return TextUtils.join("\n", changes);
    }

    private static String joined(String one, String other) {
        return other.isEmpty() ? one : one + "\n" + other;
    }
}
