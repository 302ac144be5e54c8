package org.raspilot.up.ground;

/** Hears what became of a Command: once, on the loop, perhaps before the call returned. */
public interface AnswerListener {
    /** Takes the answer. */
    void onAnswer(Answer answer);
}
