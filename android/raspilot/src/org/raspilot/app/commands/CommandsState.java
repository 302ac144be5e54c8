package org.raspilot.app.commands;

import android.app.Fragment;
import android.app.FragmentManager;
import android.os.Bundle;
import android.os.SystemClock;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.Map;
import org.raspilot.up.ground.Answer.AnswerListener;
import org.raspilot.up.ground.Answer;

/**
 * The state of the commands screen beyond its views: typed text, sent Commands, the open page.
 *
 * <p>A retained fragment without views: a rotation makes a new screen, and an answer that arrives
 * during it is still stored. Main thread only.
 */
public final class CommandsState extends Fragment {
    private static final String TAG = "commands.memory";
    private static final String DRAFTS = "commands.drafts";
    private static final String OPEN = "commands.open";
    private static final String SEARCH = "commands.search";

    private final Map<String, Map<String, String>> drafts =
            new HashMap<>();
    private final CommandHistory history = new CommandHistory();
    private final GainsEditor gains = new GainsEditor();
    private Runnable listener;
    private String open = "";
    private String search = "";

    /** Returns the memory of an activity's fragments; creates it if necessary. */
    static CommandsState of(FragmentManager manager) {
        Fragment kept = manager.findFragmentByTag(TAG);
        if (kept instanceof CommandsState) {
            return (CommandsState) kept;
        }
        CommandsState memory = new CommandsState();
        manager.beginTransaction().add(memory, TAG).commitAllowingStateLoss();
        return memory;
    }

    @Override
    public void onCreate(Bundle saved) {
        super.onCreate(saved);
        setRetainInstance(true);
        if (saved != null) {
            open = saved.getString(OPEN, "");
            search = saved.getString(SEARCH, "");
            restore(saved.getBundle(DRAFTS));
        }
    }

    @Override
    public void onSaveInstanceState(Bundle state) {
        super.onSaveInstanceState(state);
        Bundle all = new Bundle();
        for (Map.Entry<String, Map<String, String>> draft : drafts.entrySet()) {
            Bundle fields = new Bundle();
            for (Map.Entry<String, String> field : draft.getValue().entrySet()) {
                fields.putString(field.getKey(), field.getValue());
            }
            all.putBundle(draft.getKey(), fields);
        }
        state.putBundle(DRAFTS, all);
        state.putString(OPEN, open);
        state.putString(SEARCH, search);
    }

    /** Returns the typed text of a Command's form, by field; its form writes to it. */
    Map<String, String> draft(String name) {
        Map<String, String> draft = drafts.get(name);
        if (draft == null) {
            draft = new LinkedHashMap<>();
            drafts.put(name, draft);
        }
        return draft;
    }

    CommandHistory history() {
        return history;
    }

    GainsEditor gains() {
        return gains;
    }

    /** Returns the name of the Command whose form is open, or an empty text. */
    String open() {
        return open;
    }

    /** Sets the Command whose form is open; empty: none. */
    void setOpen(String name) {
        open = name;
    }

    String search() {
        return search;
    }

    void setSearch(String words) {
        search = words;
    }

    /** Sets the screen that is notified of answers; null: none. */
    void setListener(Runnable newListener) {
        listener = newListener;
    }

    /** Adds a sent Command, in words, and returns the listener for its answer. */
    AnswerListener sent(String words) {
        final CommandHistory.Entry entry = history.sent(words, SystemClock.elapsedRealtime());
        notifyListener();
        return answer -> {
            entry.answer = answer;
            notifyListener();
        };
    }

    /** Notes that something could not be sent. */
    void unsent(String words, String reason) {
        sent(words).onAnswer(Answer.refused(words, "no_link", reason));
    }

    private void notifyListener() {
        if (listener != null) {
            listener.run();
        }
    }

    private void restore(Bundle all) {
        if (all == null) {
            return;
        }
        for (String name : all.keySet()) {
            Bundle fields = all.getBundle(name);
            Map<String, String> draft = draft(name);
            for (String field : fields.keySet()) {
                draft.put(field, fields.getString(field));
            }
        }
    }
}
