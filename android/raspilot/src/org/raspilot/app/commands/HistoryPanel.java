package org.raspilot.app.commands;

import android.content.res.Resources;
import android.os.SystemClock;
import android.view.View;
import android.widget.TextView;
import java.util.List;
import org.raspilot.app.R;
import org.raspilot.app.view.InstrumentColors;
import org.raspilot.app.view.TextViews;
import org.raspilot.up.ground.Age;
import org.raspilot.up.ground.Answer;

/** The newest answer; a tap on it opens all sent Commands with their outcomes. */
final class HistoryPanel {
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
        newest.setOnClickListener(pressed -> toggle());
    }

    private boolean isOpen() {
        return box.getVisibility() == View.VISIBLE;
    }

    private void toggle() {
        box.setVisibility(isOpen() ? View.GONE : View.VISIBLE);
        update();
    }

    void update() {
        Resources words = newest.getResources();
        CommandHistory.Entry entry = history.newest();
        if (entry == null) {
            TextViews.show(newest, words.getString(R.string.commands_nothing_sent));
            TextViews.colour(newest, colors.dim);
        } else {
            TextViews.show(newest, line(words, entry));
            TextViews.colour(newest, colour(entry.answer));
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
            text.append(text.length() == 0 ? "" : "\n\n");
            text.append(words.getString(R.string.commands_entry,
                    Age.agoText(nowMs - each.atMs), line(words, each)));
        }
        return text.length() == 0 ? words.getString(R.string.commands_nothing_sent)
                : text.toString();
    }

    private static String line(Resources words, CommandHistory.Entry entry) {
        Answer answer = entry.answer;
        if (answer == null) {
            return words.getString(R.string.commands_waiting, entry.words);
        }
        switch (answer.outcome) {
            case ACK:
                return answer.roundTripMs == null
                        ? words.getString(R.string.commands_done, entry.words)
                        : words.getString(R.string.commands_done_after, entry.words,
                                answer.roundTripMs);
            case NACK:
                return words.getString(R.string.commands_refused, entry.words, answer.why());
            case REFUSED:
                return words.getString(R.string.commands_unsent, entry.words, answer.why());
            default:
                return words.getString(R.string.commands_unclear, entry.words, answer.why());
        }
    }

    private int colour(Answer answer) {
        if (answer == null) {
            return colors.ink;
        }
        switch (answer.outcome) {
            case ACK:
                return colors.good;
            case TIMEOUT:
                return colors.warning;
            default:
                return colors.alarm;
        }
    }
}
