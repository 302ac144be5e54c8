package org.raspilot.up.commands;

import java.util.List;
import java.util.Map;
import org.raspilot.up.wire.MalformedException;

/** One object of a catalogue; each reader throws when the key has another type. */
final class CatalogueEntry {
    private final Map<?, ?> description;

    private CatalogueEntry(Map<?, ?> description) {
        this.description = description;
    }

    /** Creates an entry from an element of a list. */
    static CatalogueEntry of(Object value) throws MalformedException {
        if (!(value instanceof Map)) {
            throw new MalformedException("catalogue",
                    "an entry of the catalogue must be an object");
        }
        return new CatalogueEntry((Map<?, ?>) value);
    }

    String text(String key) throws MalformedException {
        return (String) typed(key, String.class, false);
    }

    boolean flag(String key) throws MalformedException {
        return (Boolean) typed(key, Boolean.class, false);
    }

    Object value(String key) throws MalformedException {
        return typed(key, Object.class, false);
    }

    Double optionalNumber(String key) throws MalformedException {
        Object number = typed(key, Number.class, true);
        return number == null ? null : (Double) ((Number) number).doubleValue();
    }

    List<Object> list(String key) throws MalformedException {
        return listOf(typed(key, List.class, false));
    }

    List<Object> optionalList(String key) throws MalformedException {
        return listOf(typed(key, List.class, true));
    }

    FieldType type(String key) throws MalformedException {
        FieldType type = FieldType.ofWord(text(key));
        if (type == null) {
            throw new MalformedException("catalogue",
                    "the catalogue has an unknown type " + text(key));
        }
        return type;
    }

    @SuppressWarnings("unchecked")
    private static List<Object> listOf(Object value) {
        return (List<Object>) value;
    }

    private Object typed(String key, Class<?> wanted, boolean isNullable)
            throws MalformedException {
        Object value = description.get(key);
        if (value == null ? !isNullable : !wanted.isInstance(value)) {
            throw new MalformedException("catalogue", "the catalogue has no good " + key + " in "
                    + description.get("name"));
        }
        return value;
    }
}
