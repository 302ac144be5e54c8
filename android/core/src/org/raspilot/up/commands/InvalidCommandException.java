package org.raspilot.up.commands;

/**
 * A Command's data break its definition; the text is one sentence that names the field.
 *
 * <p>Source: docs/protocols.md 4 (the code {@code invalid}).
 */
public final class InvalidCommandException extends IllegalArgumentException {
    private static final long serialVersionUID = 1L;

    /** Creates it with the field and the rule it violates. */
    public InvalidCommandException(String sentence) {
        super(sentence);
    }
}
