package org.raspilot.app;

import android.app.Activity;
import android.app.Fragment;
import android.app.FragmentManager;
import android.content.ComponentName;
import android.content.Context;
import android.content.Intent;
import android.content.ServiceConnection;
import android.os.Bundle;
import android.os.Handler;
import android.os.IBinder;
import android.os.Looper;
import java.util.ArrayList;
import java.util.List;
import org.raspilot.up.android.TelemetryService;

/**
 * The one binding to the telemetry service for all fragments of the window, without a view. It
 * starts with the first watcher, survives a rotation, and ends when the window has been hidden for
 * {@link #LINGER_MS}: a look at another application does not cost the seat.
 */
public final class TelemetryLink extends Fragment {
    /** Called on the main thread. */
    public interface Watcher {
        /** Takes the service's ground, immediately if already bound; null when it is gone. */
        void onGround(TelemetryService.Ground ground);
    }

    /** The link ends this time after the window was last visible, ms. */
    static final long LINGER_MS = 30000;

    private static final String TAG = "telemetry link";

    private final Handler main = new Handler(Looper.getMainLooper());
    private final List<Watcher> watchers = new ArrayList<>();
    private final Runnable unbinding = () -> unbind();
    private final ServiceConnection connection = new ServiceConnection() {
        @Override
        public void onServiceConnected(ComponentName name, IBinder binder) {
            if (isBound && binder instanceof TelemetryService.Ground) {
                setGround((TelemetryService.Ground) binder);
            }
        }

        @Override
        public void onServiceDisconnected(ComponentName name) {
            setGround(null);
        }
    };
    private Context lasting;
    private TelemetryService.Ground ground;
    private boolean isBound;
    private boolean isSeen;
    private boolean isWanted;

    /** Creates the link of a new window, before its other fragments need it. */
    static void create(Activity activity) {
        of(activity);
        activity.getFragmentManager().executePendingTransactions();
    }

    /** Returns the link of a window; creates it if necessary. */
    public static TelemetryLink of(Activity activity) {
        FragmentManager manager = activity.getFragmentManager();
        TelemetryLink link = (TelemetryLink) manager.findFragmentByTag(TAG);
        if (link == null) {
            link = new TelemetryLink();
            manager.beginTransaction().add(link, TAG).commitAllowingStateLoss();
        }
        return link;
    }

    @Override
    public void onCreate(Bundle saved) {
        super.onCreate(saved);
        setRetainInstance(true);
        lasting = getActivity().getApplicationContext();
        bindIfDue();
    }

    @Override
    public void onStart() {
        super.onStart();
        isSeen = true;
        main.removeCallbacks(unbinding);
        bindIfDue();
    }

    @Override
    public void onStop() {
        isSeen = false;
        if (!getActivity().isChangingConfigurations()) {
            main.postDelayed(unbinding, LINGER_MS);
        }
        super.onStop();
    }

    @Override
    public void onDestroy() {
        main.removeCallbacks(unbinding);
        unbind();
        super.onDestroy();
    }

    /** Adds a watcher; the service is bound from the first one on. */
    public void addWatcher(Watcher watcher) {
        if (!watchers.contains(watcher)) {
            watchers.add(watcher);
        }
        isWanted = true;
        if (ground != null) {
            watcher.onGround(ground);
        }
        bindIfDue();
    }

    /** Removes a watcher; it is not called afterwards. */
    public void removeWatcher(Watcher watcher) {
        watchers.remove(watcher);
    }

    /** Makes the service apply the current settings, if it runs. */
    void reload() {
        if (ground != null) {
            ground.reload();
        }
    }

    private void bindIfDue() {
        if (lasting != null && isWanted && isSeen && !isBound) {
            isBound = lasting.bindService(new Intent(lasting, RaspilotTelemetryService.class),
                    connection, Context.BIND_AUTO_CREATE);
        }
    }

    private void unbind() {
        if (isBound) {
            isBound = false;
            lasting.unbindService(connection);
            setGround(null);
        }
    }

    private void setGround(TelemetryService.Ground now) {
        ground = now;
        for (Watcher watcher : new ArrayList<>(watchers)) {
            watcher.onGround(now);
        }
    }
}
