package org.raspilot.app;

import android.content.ComponentName;
import android.content.Context;
import android.content.Intent;
import android.content.ServiceConnection;
import android.os.IBinder;
import org.raspilot.up.android.BaseUpService.UpWatcher;
import org.raspilot.up.android.BaseUpService;

/**
 * A screen's view of the airborne service while it is seen: bound without creating the service,
 * so that looking starts nothing. On the main thread.
 */
final class AirborneLink {
    private final Context context;
    private final UpWatcher watcher;
    private final ServiceConnection connection = new ServiceConnection() {
        @Override
        public void onServiceConnected(ComponentName name, IBinder binder) {
            if (isBound && binder instanceof BaseUpService.Airside) {
                airside = (BaseUpService.Airside) binder;
                watcher.onStatus(null);
                airside.add(watcher);
            }
        }

        @Override
        public void onServiceDisconnected(ComponentName name) {
            airside = null;
            bindAnew();
            watcher.onStatus(null);
        }
    };
    private BaseUpService.Airside airside;
    private boolean isBound;

    /** The watcher gets null when the service does not run, or has not reported yet. */
    AirborneLink(Context context, UpWatcher watcher) {
        this.context = context.getApplicationContext();
        this.watcher = watcher;
    }

    /** Starts to watch, also a service that is started later. */
    void begin() {
        if (!isBound) {
            isBound = true;
            bind();
        }
    }

    void end() {
        if (airside != null) {
            airside.remove(watcher);
            airside = null;
        }
        if (isBound) {
            isBound = false;
            context.unbindService(connection);
        }
    }

    private void bind() {
        context.bindService(new Intent(context, RaspilotUpService.class), connection, 0);
    }

    /** A binding ends with the stopped service: the next one needs another. */
    private void bindAnew() {
        if (isBound) {
            context.unbindService(connection);
            bind();
        }
    }

    boolean isRunning() {
        return airside != null;
    }

    /** Returns the service's side; null: it does not run. */
    BaseUpService.Airside airside() {
        return airside;
    }
}
