package org.raspilot.up.wire;

import java.math.BigInteger;
import java.util.Map;

/** The id of a message: a text, or a number that is taken as its text (docs/protocols.md 4). */
final class MessageId {
    private MessageId() {
    }

    /** Returns the id of a field, or null if absent; throws for an invalid id. */
    static String read(Object value) throws MalformedException {
        if (value == null) {
            return null;
        }
        String text = null;
        if (value instanceof String) {
            text = (String) value;
        } else if (value instanceof Long || value instanceof BigInteger) {
            text = value.toString();
        } else if (value instanceof Double) {
            text = ShortestNumber.text((Double) value);
        }
        if (text == null || !GeneralMessage.hasLength(text, GeneralMessage.MAX_ID_LENGTH)) {
            throw new MalformedException(
                    "id must be text of 1 to " + GeneralMessage.MAX_ID_LENGTH + " characters");
        }
        return text;
    }

    /** Returns the id of an object that breaks a rule but is JSON, so that it can be refused. */
    static String despiteFault(String text) {
        try {
            Object fields = new JsonReader(text, false).read();
            String id = fields instanceof Map ? read(((Map<?, ?>) fields).get("id")) : null;
            return id == null || Json.loneSurrogate(id) >= 0 ? null : id;
        } catch (MalformedException noJson) {
            // The error is already reported; the message merely has no id.
            return null;
        }
    }
}
