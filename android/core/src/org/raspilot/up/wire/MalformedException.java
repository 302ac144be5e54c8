package org.raspilot.up.wire;

/**
 * Bytes that are not a valid message; the text is one short clause with the reason.
 *
 * <p>Source: docs/protocols.md 4 (the code {@code malformed}).
 */
public final class MalformedException extends Exception {
    private static final long serialVersionUID = 1L;

    private final String id;

    /** Says why, where no id could be read. */
    public MalformedException(String reason) {
        this(reason, null);
    }

    /** Says why, and the id under which it can be refused; null where none could be read. */
    public MalformedException(String reason, String id) {
        super(reason);
        this.id = id;
    }

    /** Returns why it is not a message. */
    public String reason() {
        return getMessage();
    }

    /** Returns the id that the message had where it could still be read, else null. */
    public String id() {
        return id;
    }
}
