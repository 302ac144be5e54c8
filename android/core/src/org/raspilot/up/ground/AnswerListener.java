package org.raspilot.up.ground;

/** Receives the outcome of a Command: once, on the loop, possibly before the call returns. */
public interface AnswerListener {
    void onAnswer(Answer answer);
}
