package org.raspilot.up.airborne;

/** Says a text aloud: Android's text to speech, or a line of the virtual phone. */
public interface Speaker {
    /** Says it; called on the loop, is not to block. */
    void speak(String text);
}
