package org.raspilot.up.commands;

import java.util.Locale;

/** Why a Command was not carried out: the codes of {@code up.nack} (docs/protocols.md 4). */
public enum NackCode {
    /** It was no General Message. */
    MALFORMED,
    /** There is no Command of that name. */
    UNKNOWN,
    /** A field is missing, of a wrong type, or out of range. */
    INVALID,
    /** The link's role or its configuration does not permit it. */
    FORBIDDEN,
    /** The echoed beacon is older than 2 s, or than a longer period of telemetry and 1 s. */
    STALE,
    /** Arming and disarming need an echoed beacon. */
    NO_BEACON,
    /** The aircraft has not sent the echoed beacon since its start. */
    UNKNOWN_BEACON,
    /** Understood, permitted, and refused by whoever carries it out. */
    REFUSED,
    /** Whoever would carry it out is absent. */
    UNAVAILABLE,
    /** Another phone is connected. */
    TAKEN,
    /** Panic Mode: the Raspberry Pi is too busy for it now. */
    OVERLOADED,
    /** No answer from whoever carries it out. */
    TIMEOUT,
    /** Carrying it out failed inside. */
    FAILED,
    /** Nothing carries it out yet; the reason says what is missing. */
    NOT_SUPPORTED;

    /** Returns the word that stands on the wire. */
    public String word() {
        return name().toLowerCase(Locale.ROOT);
    }

    /** Returns the code of a word, or null when it is none that is known. */
    public static NackCode ofWord(String word) {
        for (NackCode code : values()) {
            if (code.word().equals(word)) {
                return code;
            }
        }
        return null;
    }
}
