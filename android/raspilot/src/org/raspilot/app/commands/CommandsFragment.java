package org.raspilot.app.commands;

import android.app.Fragment;
import android.os.Bundle;
import android.os.Handler;
import android.view.LayoutInflater;
import android.view.View;
import android.view.ViewGroup;
import java.io.IOException;
import java.util.Collections;
import java.util.List;
import org.raspilot.app.R;
import org.raspilot.app.TelemetryLink;
import org.raspilot.up.android.GroundWatcher;
import org.raspilot.up.android.TelemetryService;
import org.raspilot.up.commands.CommandForm;
import org.raspilot.up.ground.GroundStatus;
import org.raspilot.up.ground.Telemetry;

/**
 * The commands screen: every Command with its form, its answer and the history (thesis 4.5.3).
 *
 * <p>Bound from start to stop. What was typed and sent outlives a rotation in
 * {@link CommandsMemory}. Main thread only.
 */
public final class CommandsFragment extends Fragment implements CommandsMemory.Listener {
    private static final long TICK_MS = 200;

    private final Handler handler = new Handler();
    private final Runnable tick = new Runnable() {
        @Override
        public void run() {
            show();
            handler.postDelayed(this, TICK_MS);
        }
    };
    private final GroundWatcher watcher = new GroundWatcher() {
        @Override
        public void onTelemetry(Telemetry telemetry) {
            if (screen != null) {
                screen.showFrame();
            }
        }

        @Override
        public void onStatus(GroundStatus status) {
            show();
        }

        @Override
        public void onChanged() {
            show();
        }
    };
    private final TelemetryLink.Watcher linkWatcher = new TelemetryLink.Watcher() {
        @Override
        public void onGround(TelemetryService.Ground newGround) {
            take(newGround);
        }

        @Override
        public void onGroundGone() {
            take(null);
        }
    };

    private CommandsMemory memory;
    private List<CommandForm> forms = Collections.emptyList();
    private String fault = "";
    private TelemetryLink link;
    private TelemetryService.Ground ground;
    private CommandsScreen screen;

    @Override
    public void onCreate(Bundle saved) {
        super.onCreate(saved);
        memory = CommandsMemory.of(getFragmentManager());
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
        super.onStart();
        memory.setListener(this);
        link = TelemetryLink.of(getActivity());
        link.watch(linkWatcher);
        handler.removeCallbacks(tick);
        tick.run();
    }

    @Override
    public void onStop() {
        handler.removeCallbacks(tick);
        if (link != null) {
            link.unwatch(linkWatcher);
            link = null;
        }
        take(null);
        memory.setListener(null);
        if (screen != null) {
            // Nobody says yes to a question that they do not see.
            screen.dismiss();
        }
        super.onStop();
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
    public void onHistory() {
        show();
    }

    private void take(TelemetryService.Ground newGround) {
        if (ground == newGround) {
            return;
        }
        if (ground != null) {
            ground.remove(watcher);
        }
        ground = newGround;
        if (screen != null) {
            screen.setGround(newGround);
        }
        if (newGround != null) {
            newGround.add(watcher);
        }
        show();
    }

    private void show() {
        if (screen != null) {
            screen.show();
        }
    }
}
