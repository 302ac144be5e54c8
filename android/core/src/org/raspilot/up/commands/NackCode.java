package org.raspilot.up.commands;

import java.util.Locale;

/** Why a Command was not carried out: the codes of {@code up.nack} (docs/protocols.md 4). */
public enum NackCode {
    // schema begin
    /** Not a General Message. */
    MALFORMED,
    /** No Command of that name. */
    UNKNOWN,
    /** A field is missing, of a wrong type, or out of range; the reason names it. */
    INVALID,
    /** The link's role, or its configuration now, does not permit it; the reason names the key to change. */
    FORBIDDEN,
    /** The link requires protected messages: pair this device with a key of the aircraft. */
    UNPROTECTED,
    /** The echoed beacon is older than 2 s, or, where telemetry's period is longer, than that and 1 s. */
    STALE,
    /** Arming and disarming need an echoed beacon. */
    NO_BEACON,
    /** The aircraft has not sent the echoed beacon since its start: it is from the future or from another run. */
    UNKNOWN_BEACON,
    /** Nothing carries it out yet; the reason names the missing part: no navigation, no controller that uses the gain. */
    NOT_SUPPORTED,
    /** Valid, permitted, and refused by the handler, with a reason. */
    REFUSED,
    /** The handler is absent. */
    UNAVAILABLE,
    /** Another phone is connected; the reason names its address. */
    TAKEN,
    /** Panic Mode does not permit it now: a telemetry period below panic's delay. Nothing of it is kept. */
    OVERLOADED,
    /** No answer from the handler within 2 s. */
    TIMEOUT,
    /** The handler failed with an internal error; the log names the place. */
    FAILED,
    // schema end
    ;

    public String word() {
        return name().toLowerCase(Locale.ROOT);
    }
}
