package org.raspilot.up.wire;

/**
 * Bytes that are not a valid message; the text is one short clause with the reason.
 *
 * <p>Source: docs/protocols.md 4 (the code {@code malformed}).
 */
public final class MalformedException extends Exception {
    private static final long serialVersionUID = 1L;

    /** What is wrong, as a stable word: {@code not_json too_long repeated_key ...}. */
    public final String code;

    /** The id of the message if it was readable, otherwise null. */
    public final String id;

    /** Creates it with a code and the reason, without an id. */
    public MalformedException(String code, String reason) {
        this(code, reason, null);
    }

    /** Creates it with the id to refuse the message under; null if the id is unreadable. */
    public MalformedException(String code, String reason, String id) {
        super(reason);
        this.code = code;
        this.id = id;
    }

    public String reason() {
        return getMessage();
    }
}
