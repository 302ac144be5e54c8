package org.raspilot.up.virtual_phone;

import java.util.List;
import java.util.Map;
import org.raspilot.up.virtual_phone.OptionParser.OptionException;
import org.raspilot.up.wire.Json;
import org.raspilot.up.wire.MalformedException;

/** One line of input. */
final class InputLine {
    final Map<?, ?> fields;

    private InputLine(Map<?, ?> fields) {
        this.fields = fields;
    }

    /** Returns a line's contents; raises OptionException with a sentence. */
    static InputLine read(String text) throws OptionException {
        try {
            Object value = Json.parse(text);
            if (value instanceof Map) {
                return new InputLine((Map<?, ?>) value);
            }
        } catch (MalformedException error) {
            throw new OptionException("a line is not JSON: " + error.getMessage());
        }
        throw new OptionException("a line must be a JSON object");
    }

    /** Returns the time of a stepped line, ms; throws OptionException if it is missing. */
    long timeMs() throws OptionException {
        Object value = fields.get("t");
        if (!(value instanceof Long)) {
            throw new OptionException("a line needs the time 't', ms");
        }
        return (Long) value;
    }

    /** Returns the events of the network, or null. Throws OptionException. */
    List<?> network() throws OptionException {
        Object value = fields.get("net");
        if (value != null && !(value instanceof List)) {
            throw new OptionException("net must be a list");
        }
        return (List<?>) value;
    }
}
