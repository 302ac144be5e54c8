package org.raspilot.up.wire;

import java.util.ArrayList;
import java.util.Collection;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** Deeply immutable copies of JSON values. */
public final class ImmutableCopy {
    private ImmutableCopy() {
    }

    /** Returns a copy of an object. */
    public static Map<String, Object> map(Map<String, ?> fields) {
        Map<String, Object> copy = new LinkedHashMap<>();
        for (Map.Entry<String, ?> field : fields.entrySet()) {
            copy.put(field.getKey(), value(field.getValue()));
        }
        return Collections.unmodifiableMap(copy);
    }

    @SuppressWarnings("unchecked")
    private static Object value(Object value) {
        if (value instanceof Map) {
            return map((Map<String, ?>) value);
        }
        if (value instanceof Collection) {
            List<Object> copy = new ArrayList<>();
            for (Object item : (Collection<?>) value) {
                copy.add(value(item));
            }
            return Collections.unmodifiableList(copy);
        }
        return value;
    }
}
