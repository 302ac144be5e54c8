package org.raspilot.app.ground;

import android.content.Context;
import android.media.AudioManager;
import android.media.ToneGenerator;
import android.os.Vibrator;
import android.util.Log;
import org.raspilot.up.ground.EventLevel;

/** Sounds and vibrates for alarms; a phone that can do neither does neither. Main thread only. */
final class Sounder {
    private static final String TAG = "Sounder";
    private static final int VOLUME = ToneGenerator.MAX_VOLUME;
    private static final int WARNING_TONE_MS = 250;
    private static final int ALARM_TONE_MS = 700;
    private static final long[] WARNING_VIBRATION_MS = {0, 200};
    private static final long[] ALARM_VIBRATION_MS = {0, 250, 100, 250, 100, 250};

    private final Context context;
    private ToneGenerator tones;

    /** Creates a sounder that holds no resources of the system yet. */
    Sounder(Context context) {
        this.context = context.getApplicationContext();
    }

    /** Sounds an alarm or a warning; null: nothing. */
    void ring(EventLevel ring) {
        if (ring == null) {
            return;
        }
        boolean isAlarm = ring == EventLevel.ALARM;
        if (tones == null) {
            tones = newTones();
        }
        if (tones != null) {
            tones.startTone(isAlarm ? ToneGenerator.TONE_CDMA_ALERT_CALL_GUARD
                    : ToneGenerator.TONE_PROP_BEEP2, isAlarm ? ALARM_TONE_MS : WARNING_TONE_MS);
        }
        Vibrator vibrator = (Vibrator) context.getSystemService(Context.VIBRATOR_SERVICE);
        if (vibrator != null && vibrator.hasVibrator()) {
            vibrator.vibrate(isAlarm ? ALARM_VIBRATION_MS : WARNING_VIBRATION_MS, -1);
        }
    }

    void stop() {
        if (tones != null) {
            tones.stopTone();
        }
        Vibrator vibrator = (Vibrator) context.getSystemService(Context.VIBRATOR_SERVICE);
        if (vibrator != null) {
            vibrator.cancel();
        }
    }

    /** Stops the sound and releases its resources. */
    void release() {
        if (tones != null) {
            stop();
            tones.release();
            tones = null;
        }
    }

    private static ToneGenerator newTones() {
        try {
            return new ToneGenerator(AudioManager.STREAM_ALARM, VOLUME);
        } catch (RuntimeException none) {
            // The system throws this when it has no audio track left: vibration remains.
            Log.w(TAG, "no tone can be sounded", none);
            return null;
        }
    }
}
