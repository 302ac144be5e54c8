package org.raspilot.up.commands;

/**
 * Thrown by a handler that understood a Command and will not carry it out.
 *
 * <p>Source: docs/protocols.md 4 (the codes of {@code up.nack}).
 */
public final class CommandRefusedException extends Exception {
    private static final long serialVersionUID = 1L;

    public final NackCode code;

    /** Refuses with the code {@code refused}. */
    public CommandRefusedException(String reason) {
        this(NackCode.REFUSED, reason);
    }

    /** Refuses with a code; the reason is a sentence for the asker. */
    public CommandRefusedException(NackCode code, String reason) {
        super(reason);
        this.code = code;
    }

    public String reason() {
        return getMessage();
    }
}
