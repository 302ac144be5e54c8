package org.raspilot.up.android;

import android.content.BroadcastReceiver;
import android.content.Context;
import android.content.Intent;
import android.content.IntentFilter;
import android.os.BatteryManager;
import android.os.Handler;
import java.util.concurrent.Executor;
import org.raspilot.up.android.SensorProblem.SensorTexts;
import org.raspilot.up.providers.BatteryProvider.BatteryLevel;
import org.raspilot.up.providers.SensorListener;
import org.raspilot.up.providers.SensorSource;

/** The battery level that the system reports: once at first, then on each change. */
public final class BatterySource extends BroadcastReceiver implements SensorSource<BatteryLevel> {
    private final Context context;
    private final Handler handler;
    private final String absence;
    private final LatestReading<BatteryLevel> handover;
    private boolean isListening;

    /** Takes a context that outlives every subscription. */
    BatterySource(Context context, Handler handler, Executor loop, SensorTexts texts) {
        this.context = context;
        this.handler = handler;
        absence = texts.of(SensorProblem.BATTERY);
        handover = new LatestReading<>(loop);
    }

    @Override
    public boolean isPresent() {
        return level(context) != null;
    }

    @Override
    public String name() {
        Intent newest = context.registerReceiver(null, filter());
        String technology = newest == null ? null
                : newest.getStringExtra(BatteryManager.EXTRA_TECHNOLOGY);
        if (level(newest) == null) {
            return absence;
        }
        return technology == null ? "" : technology;
    }

    @Override
    public void subscribe(long periodMs, SensorListener<BatteryLevel> listener) {
        handover.setListener(listener);
        if (!isListening) {
            isListening = true;
            context.registerReceiver(this, filter(), null, handler);
        }
    }

    @Override
    public void unsubscribe() {
        handover.setListener(null);
        if (isListening) {
            isListening = false;
            context.unregisterReceiver(this);
        }
    }

    @Override
    public void onReceive(Context unused, Intent intent) {
        BatteryLevel level = level(intent);
        if (level != null) {
            handover.put(level);
        }
    }

    /** Returns the present level, or null if absent. */
    public static BatteryLevel level(Context context) {
        return level(context.registerReceiver(null, filter()));
    }

    private static IntentFilter filter() {
        return new IntentFilter(Intent.ACTION_BATTERY_CHANGED);
    }

    /** Returns the level of the system's message, or null if absent. */
    static BatteryLevel level(Intent intent) {
        if (intent == null) {
            return null;
        }
        int level = intent.getIntExtra(BatteryManager.EXTRA_LEVEL, -1);
        int scale = intent.getIntExtra(BatteryManager.EXTRA_SCALE, -1);
        boolean isTold = level >= 0 && scale > 0 && level <= scale;
        return isTold ? new BatteryLevel(100.0 * level / scale) : null;
    }
}
