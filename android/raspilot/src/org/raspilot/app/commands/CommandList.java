package org.raspilot.app.commands;

import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import android.widget.BaseAdapter;
import android.widget.TextView;
import java.util.ArrayList;
import java.util.BitSet;
import java.util.Collections;
import java.util.List;
import org.raspilot.app.R;
import org.raspilot.app.view.InstrumentColors;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.commands.CommandForm;
import org.raspilot.up.ground.CommandGate.DisabledReason;

/** Every Command of the catalogue in groups, filtered by the searched words. */
final class CommandList extends BaseAdapter {
    private static final int HEADING = 0;
    private static final int COMMAND = 1;

    private final LayoutInflater inflater;
    private final CommandsScreen desk;
    private final InstrumentColors colors;
    private final List<CommandForm> forms;
    /** Groups and forms as they stand below each other. */
    private final List<Object> lines = new ArrayList<>();
    private BitSet offered = new BitSet();

    CommandList(CommandsScreen desk, List<CommandForm> forms) {
        this.desk = desk;
        this.forms = forms;
        inflater = LayoutInflater.from(desk.context());
        colors = InstrumentColors.of(desk.context());
        search("");
    }

    /** Shows the Commands whose title, name or text contains each of the words. */
    void search(String wanted) {
        lines.clear();
        for (CommandGroup group : CommandGroup.values()) {
            boolean isBegun = false;
            for (CommandForm form : forms) {
                if (CommandGroup.of(form.name) == group && matches(form, wanted)) {
                    if (!isBegun) {
                        lines.add(group);
                        isBegun = true;
                    }
                    lines.add(form);
                }
            }
        }
        notifyDataSetChanged();
    }

    /** Updates the list of offered Commands; an unchanged list stays as it was under a finger. */
    void refresh() {
        BitSet now = new BitSet();
        for (int place = 0; place < lines.size(); place++) {
            CommandForm form = form(place);
            now.set(place, form != null && isOffered(form));
        }
        if (!now.equals(offered)) {
            offered = now;
            notifyDataSetChanged();
        }
    }

    /** Returns the form at a place; null for a heading. */
    CommandForm form(int place) {
        Object line = lines.get(place);
        return line instanceof CommandForm ? (CommandForm) line : null;
    }

    @Override
    public int getCount() {
        return lines.size();
    }

    @Override
    public Object getItem(int place) {
        return lines.get(place);
    }

    @Override
    public long getItemId(int place) {
        return place;
    }

    @Override
    public int getViewTypeCount() {
        return 2;
    }

    @Override
    public int getItemViewType(int place) {
        return form(place) == null ? HEADING : COMMAND;
    }

    @Override
    public boolean areAllItemsEnabled() {
        return false;
    }

    @Override
    public boolean isEnabled(int place) {
        return form(place) != null;
    }

    @Override
    public View getView(int place, View used, ViewGroup list) {
        CommandForm form = form(place);
        if (form == null) {
            View heading = used == null
                    ? inflater.inflate(R.layout.heading_commands, list, false) : used;
            ((TextView) heading).setText(CommandTexts.group((CommandGroup) lines.get(place)));
            return heading;
        }
        View row = used == null ? inflater.inflate(R.layout.row_command, list, false) : used;
        TextView title = (TextView) row.findViewById(R.id.command_title);
        title.setText(CommandTexts.title(form.name));
        ((TextView) row.findViewById(R.id.command_name)).setText(form.name);
        // It opens nevertheless: its page states why it is not offered.
        TextViews.colour(title, isOffered(form) ? colors.ink : colors.dim);
        return row;
    }

    private boolean isOffered(CommandForm form) {
        return desk.objection(form, Collections.emptyMap()) == DisabledReason.NONE;
    }

    private boolean matches(CommandForm form, String wanted) {
        StringBuilder aliases = new StringBuilder();
        for (String alias : form.aliases) {
            aliases.append(alias).append(' ');
        }
        return CommandGroup.matches(wanted, form.name, form.text, aliases.toString(),
                CommandTexts.title(form.name));
    }
}
