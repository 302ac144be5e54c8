package org.raspilot.up.android;

/** The application's texts for missing parts of a phone. Called on any thread. */
public interface SensorTexts {
    /** Returns a sentence without a full stop. */
    String of(SensorProblem lack);
}
