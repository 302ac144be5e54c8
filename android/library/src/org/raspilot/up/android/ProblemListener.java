package org.raspilot.up.android;

/** Receives the problems of the phone's own parts. Called on any thread. */
public interface ProblemListener {
    /** Takes a sentence without a full stop. */
    void onProblem(String sentence);
}
