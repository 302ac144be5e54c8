package org.raspilot.up.android;

import android.content.Context;
import android.os.Handler;
import android.os.Looper;
import org.raspilot.up.android.SensorProblem.SensorTexts;
import org.raspilot.up.providers.Rotation;
import org.raspilot.up.providers.SensorListener;
import org.raspilot.up.providers.SensorSource;

/**
 * Delivers the phone's orientation to a screen, whether or not it is sent. All on the main thread.
 */
public final class RotationFeed {
    private final SensorSource<Rotation> source;

    /** Finds the available source of orientation. */
    public RotationFeed(Context context, SensorTexts texts, ProblemListener problems) {
        final Handler main = new Handler(Looper.getMainLooper());
        SensorAccess desk = new SensorAccess(context.getApplicationContext(),
                Looper.getMainLooper());
        source = AndroidSources.rotation(desk, call -> main.post(call), texts, problems);
    }

    /** Returns whether this phone has an orientation source. */
    public boolean isPresent() {
        return source.isPresent();
    }

    /** Returns the name of its source, or a sentence about its absence. */
    public String name() {
        return source.name();
    }

    /** Starts to report it; without a source nothing is reported. */
    public void begin(long periodMs, SensorListener<Rotation> listener) {
        if (source.isPresent()) {
            source.subscribe(periodMs, listener);
        }
    }

    public void end() {
        source.unsubscribe();
    }
}
