package org.raspilot.up.android;

import android.content.Context;
import android.os.Handler;
import android.os.Looper;
import android.speech.tts.TextToSpeech;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import org.raspilot.up.airborne.Speaker;
import org.raspilot.up.android.SensorProblem.SensorTexts;

/** Speaks texts by the phone's own text to speech; texts wait until it is ready. */
final class AndroidSpeaker implements Speaker, TextToSpeech.OnInitListener {
    private static final int MAX_WAITING = 5;

    private final Handler main = new Handler(Looper.getMainLooper());
    private final List<String> waiting = new ArrayList<>();
    private final ProblemListener problems;
    private final String absence;
    private TextToSpeech speech;
    private boolean isReady;
    private boolean isEnded;

    /** Starts to initialize text to speech; on the main thread. */
    AndroidSpeaker(Context context, SensorTexts texts, ProblemListener problems) {
        this.problems = problems;
        absence = texts.of(SensorProblem.SPEECH);
        speech = new TextToSpeech(context.getApplicationContext(), this);
    }

    @Override
    public void speak(final String text) {
        main.post(() -> speakNow(text));
    }

    @Override
    public void onInit(final int status) {
        // Some systems call while the constructor still runs.
        main.post(() -> begin(status == TextToSpeech.SUCCESS));
    }

    /** Falls silent for good; on the main thread. */
    void end() {
        isEnded = true;
        waiting.clear();
        if (speech != null) {
            speech.shutdown();
            speech = null;
        }
    }

    private void begin(boolean isSuccess) {
        if (isEnded) {
            return;
        }
        isReady = isSuccess;
        if (!isSuccess) {
            speech.shutdown();
            speech = null;
            problems.onProblem(absence);
        }
        for (String text : waiting) {
            speakNow(text);
        }
        waiting.clear();
    }

    private void speakNow(String text) {
        if (isEnded || speech == null) {
            return;
        }
        if (isReady) {
            speech.speak(text, TextToSpeech.QUEUE_ADD, new HashMap<>());
        } else if (waiting.size() < MAX_WAITING) {
            waiting.add(text);
        }
    }
}
