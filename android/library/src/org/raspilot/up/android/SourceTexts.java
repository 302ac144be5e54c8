package org.raspilot.up.android;

/** The application's words for what a phone lacks. Asked on any thread. */
public interface SourceTexts {
    /** Returns a sentence without a full stop. */
    String of(Lack lack);
}
