package org.raspilot.up.security;

/** A refused protected message or handshake. */
public final class EnvelopeException extends Exception {
    private static final long serialVersionUID = 1L;

    /** Why: {@code malformed forged replayed unknown_stream}. */
    public final String code;

    EnvelopeException(String code) {
        super(code);
        this.code = code;
    }
}
