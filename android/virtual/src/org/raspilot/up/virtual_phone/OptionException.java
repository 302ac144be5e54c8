package org.raspilot.up.virtual_phone;

/** Invalid input of a program: one sentence for the user. */
final class OptionException extends Exception {
    private static final long serialVersionUID = 1;

    OptionException(String sentence) {
        super(sentence);
    }
}
