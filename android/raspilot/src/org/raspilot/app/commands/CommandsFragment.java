package org.raspilot.app.commands;

import android.os.Bundle;
import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import java.io.IOException;
import java.util.Collections;
import java.util.List;
import org.raspilot.app.R;
import org.raspilot.app.WatchingFragment;
import org.raspilot.up.android.TelemetryService;
import org.raspilot.up.commands.CommandForm;

/**
 * The commands screen: every Command with its form, its answer and the history (thesis 4.5.3).
 *
 * <p>{@link CommandsState} preserves typed and sent data across a rotation. Main thread only.
 */
public final class CommandsFragment extends WatchingFragment {
    private CommandsState memory;
    private List<CommandForm> forms = Collections.emptyList();
    private String fault = "";
    private CommandsScreen screen;

    @Override
    public void onCreate(Bundle saved) {
        super.onCreate(saved);
        memory = CommandsState.of(getFragmentManager());
        try {
            forms = CatalogueAsset.read(getActivity()).forms();
        } catch (IOException failure) {
            fault = failure.getMessage();
        }
    }

    @Override
    public View onCreateView(LayoutInflater inflater, ViewGroup container, Bundle saved) {
        View root = inflater.inflate(R.layout.fragment_commands, container, false);
        root.setKeepScreenOn(true);
        screen = new CommandsScreen(getActivity(), root, memory, forms, fault);
        return root;
    }

    @Override
    public void onStart() {
        memory.setListener(() -> showAll());
        super.onStart();
    }

    @Override
    public void onStop() {
        super.onStop();
        memory.setListener(null);
        if (screen != null) {
            // A dialog that is not visible must not be confirmed.
            screen.dismiss();
        }
    }

    @Override
    public void onDestroyView() {
        if (screen != null) {
            screen.close();
            screen = null;
        }
        super.onDestroyView();
    }

    @Override
    protected void onGround(TelemetryService.Ground newGround) {
        if (screen != null) {
            screen.setGround(newGround);
        }
    }

    @Override
    protected void showNewest() {
        if (screen != null) {
            screen.showFrame();
        }
    }

    @Override
    protected void showAll() {
        if (screen != null) {
            screen.show();
        }
    }
}
