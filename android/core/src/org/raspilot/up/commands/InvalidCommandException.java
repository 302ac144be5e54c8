package org.raspilot.up.commands;

/**
 * A Command's data break its definition; the text is one sentence that names the field.
 *
 * <p>Source: docs/protocols.md 4 (the code {@code invalid}).
 */
public final class InvalidCommandException extends IllegalArgumentException {
    private static final long serialVersionUID = 1L;

    /**
     * What is wrong: {@code missing unknown wrong_type out_of_range unknown_choice too_long empty
     * malformed incomplete}.
     */
    public final String code;

    /** The field, or the place in it: {@code pids.ratePIDs.ailerons.p}. */
    public final String field;

    private final String rule;

    /** Creates it; {@code rule} follows the field's name in the sentence. */
    public InvalidCommandException(String code, String field, String rule) {
        this(code, field, field, rule);
    }

    private InvalidCommandException(String code, String field, String name, String rule) {
        super(name + " " + rule);
        this.code = code;
        this.field = field;
        this.rule = rule;
    }

    /** Returns the same error with another name of the field in its sentence. */
    public InvalidCommandException naming(String name) {
        return new InvalidCommandException(code, field, name, rule);
    }
}
