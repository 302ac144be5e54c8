package org.raspilot.app.commands;

import android.content.res.Resources;
import android.os.SystemClock;
import android.view.View;
import android.widget.TextView;
import java.util.List;
import org.raspilot.app.R;
import org.raspilot.app.view.InstrumentColors;
import org.raspilot.app.view.TextViews;

/** The newest answer; a tap on it opens all sent Commands with their outcomes. */
final class HistoryPanel implements View.OnClickListener {
    private final CommandHistory history;
    private final TextView newest;
    private final View box;
    private final TextView all;
    private final InstrumentColors colors;

    HistoryPanel(View root, CommandHistory history) {
        this.history = history;
        colors = InstrumentColors.of(root.getContext());
        newest = (TextView) root.findViewById(R.id.commands_newest);
        box = root.findViewById(R.id.commands_history_box);
        all = (TextView) root.findViewById(R.id.commands_history);
        newest.setOnClickListener(this);
    }

    /** Returns whether the whole history is open. */
    boolean isOpen() {
        return box.getVisibility() == View.VISIBLE;
    }

    void setOpen(boolean isOpen) {
        box.setVisibility(isOpen ? View.VISIBLE : View.GONE);
        update();
    }

    @Override
    public void onClick(View view) {
        setOpen(!isOpen());
    }

    void update() {
        Resources words = newest.getResources();
        CommandHistory.Entry entry = history.newest();
        if (entry == null) {
            TextViews.show(newest, words.getString(R.string.commands_nothing_sent));
            TextViews.colour(newest, colors.dim);
        } else {
            TextViews.show(newest, line(words, entry));
            TextViews.colour(newest, colour(entry.outcome));
        }
        if (isOpen()) {
            TextViews.show(all, allText(words));
        }
    }

    private String allText(Resources words) {
        List<CommandHistory.Entry> entries = history.entries();
        long nowMs = SystemClock.elapsedRealtime();
        StringBuilder text = new StringBuilder();
        for (CommandHistory.Entry each : entries) {
            long agoS = Math.max(0, nowMs - each.atMs) / 1000;
            String ago = agoS < 100 ? agoS + " s" : agoS / 60 + " min";
            text.append(text.length() == 0 ? "" : "\n\n");
            text.append(words.getString(R.string.commands_entry, ago, line(words, each)));
        }
        return text.length() == 0 ? words.getString(R.string.commands_nothing_sent)
                : text.toString();
    }

    private static String line(Resources words, CommandHistory.Entry entry) {
        switch (entry.outcome) {
            case WAITING:
                return words.getString(R.string.commands_waiting, entry.words);
            case GOOD:
                return entry.roundTripMs == null
                        ? words.getString(R.string.commands_done, entry.words)
                        : words.getString(R.string.commands_done_after, entry.words,
                                entry.roundTripMs);
            case REFUSED:
                return words.getString(R.string.commands_refused, entry.words, entry.reason);
            case UNSENT:
                return words.getString(R.string.commands_unsent, entry.words, entry.reason);
            default:
                return words.getString(R.string.commands_unclear, entry.words, entry.reason);
        }
    }

    private int colour(CommandHistory.Outcome outcome) {
        switch (outcome) {
            case GOOD:
                return colors.good;
            case REFUSED:
            case UNSENT:
                return colors.alarm;
            case UNKNOWN:
                return colors.warning;
            default:
                return colors.ink;
        }
    }
}
