package org.raspilot.up.commands;

import java.util.Locale;

/** The type of a Command's field, as in the catalogue. */
public enum FieldType {
    BOOLEAN,
    INTEGER,
    NUMBER,
    TEXT,
    /** An object of further fields; its contents are not described. */
    OBJECT,
    /** A list; its contents are not described. */
    LIST;

    public String word() {
        return name().toLowerCase(Locale.ROOT);
    }

    /** Returns the type with that name, or null if unknown. */
    public static FieldType ofWord(String word) {
        for (FieldType type : values()) {
            if (type.word().equals(word)) {
                return type;
            }
        }
        return null;
    }
}
