package org.raspilot.up.airborne;

/** Speaks a text: Android's text to speech, or a line of the virtual phone. */
public interface Speaker {
    /** Speaks the text; called on the loop and must not block. */
    void speak(String text);
}
