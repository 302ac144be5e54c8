package org.raspilot.app;

import android.app.Fragment;
import android.content.ClipData;
import android.content.ClipboardManager;
import android.content.Context;
import android.content.Intent;
import android.os.Bundle;
import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import android.widget.ArrayAdapter;
import android.widget.ListView;
import android.widget.Toast;
import java.text.DateFormat;
import java.text.SimpleDateFormat;
import java.util.Date;
import java.util.Locale;

/** The log screen: the events since the application started, to read, share and copy. */
public final class LogFragment extends Fragment implements AppLog.Watcher {
    private final DateFormat time = new SimpleDateFormat("HH:mm:ss", Locale.US);

    private ArrayAdapter<String> lines;

    @Override
    public View onCreateView(LayoutInflater inflater, ViewGroup container, Bundle saved) {
        View root = inflater.inflate(R.layout.fragment_log, container, false);
        lines = new ArrayAdapter<>(getActivity(), R.layout.row_log);
        ListView list = (ListView) root.findViewById(R.id.log_lines);
        list.setAdapter(lines);
        list.setEmptyView(root.findViewById(R.id.log_empty));
        root.findViewById(R.id.log_share).setOnClickListener(pressed -> share());
        root.findViewById(R.id.log_copy).setOnClickListener(pressed -> copy());
        root.findViewById(R.id.log_clear).setOnClickListener(pressed -> events().clear());
        return root;
    }

    @Override
    public void onStart() {
        super.onStart();
        events().addWatcher(this);
        onEvents();
    }

    @Override
    public void onStop() {
        events().removeWatcher(this);
        super.onStop();
    }

    @Override
    public void onDestroyView() {
        lines = null;
        super.onDestroyView();
    }

    @Override
    public void onEvents() {
        if (lines == null) {
            return;
        }
        lines.setNotifyOnChange(false);
        lines.clear();
        for (AppLog.Entry entry : events().entries()) {
            lines.add(line(entry));
        }
        lines.notifyDataSetChanged();
    }

    private void share() {
        Intent intent = new Intent(Intent.ACTION_SEND)
                .setType("text/plain")
                .putExtra(Intent.EXTRA_SUBJECT, getString(R.string.log_subject))
                .putExtra(Intent.EXTRA_TEXT, all());
        startActivity(Intent.createChooser(intent, getString(R.string.log_share)));
    }

    private void copy() {
        ClipboardManager clipboard = (ClipboardManager)
                getActivity().getSystemService(Context.CLIPBOARD_SERVICE);
        clipboard.setPrimaryClip(ClipData.newPlainText(getString(R.string.log_subject),
                all()));
        Toast.makeText(getActivity(), R.string.log_copied, Toast.LENGTH_SHORT).show();
    }

    /** Returns one line: its time, what happened and how often. */
    private String line(AppLog.Entry entry) {
        String text = entry.times == 1 ? entry.text
                : getString(R.string.log_times, entry.text, entry.times);
        return time.format(new Date(entry.timeMs)) + "  " + text;
    }

    private String all() {
        StringBuilder text = new StringBuilder();
        for (AppLog.Entry entry : events().entries()) {
            text.append(line(entry)).append('\n');
        }
        return text.toString();
    }

    private AppLog events() {
        return RaspilotApplication.of(getActivity()).events();
    }
}
