package org.raspilot.up.wire;

/**
 * Bytes that are not a valid message; the text is one short clause with the reason.
 *
 * <p>Source: docs/protocols.md 4 (the code {@code malformed}).
 */
public final class MalformedException extends Exception {
    private static final long serialVersionUID = 1L;

    /** The id of the message if it was readable, otherwise null. */
    public final String id;

    /** Creates it with the reason, without an id. */
    public MalformedException(String reason) {
        this(reason, null);
    }

    /** Creates it with the reason and the id to refuse it under; null if the id is unreadable. */
    public MalformedException(String reason, String id) {
        super(reason);
        this.id = id;
    }

    /** Returns why it is not a message. */
    public String reason() {
        return getMessage();
    }
}
