package org.raspilot.up.commands;

import java.util.Locale;

/** Why a Command was not carried out: the codes of {@code up.nack} (docs/protocols.md 4). */
public enum NackCode {
    /** It was no General Message. */
    MALFORMED,
    /** Unknown Command name. */
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
    /** Understood and permitted, but refused by the component that executes it. */
    REFUSED,
    /** The component that would execute it is absent. */
    UNAVAILABLE,
    /** Another phone is connected. */
    TAKEN,
    /** Panic Mode: the Raspberry Pi is too busy for it now. */
    OVERLOADED,
    /** The component that executes it did not answer. */
    TIMEOUT,
    /** Carrying it out failed inside. */
    FAILED,
    /** Not implemented by any component; the reason names the missing part. */
    NOT_SUPPORTED;

    /** Returns the word on the wire. */
    public String word() {
        return name().toLowerCase(Locale.ROOT);
    }

    /** Returns the code with that name, or null if unknown. */
    public static NackCode ofWord(String word) {
        for (NackCode code : values()) {
            if (code.word().equals(word)) {
                return code;
            }
        }
        return null;
    }
}
