package org.raspilot.up.wire;

import java.math.BigInteger;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;

/**
 * One General Message: its Command, its fields, and optionally an id for an answer and a beacon.
 *
 * <p>Source: docs/protocols.md 4, thesis 3.1.4.
 */
public final class GeneralMessage {
    public static final int MAX_NAME_LENGTH = 128;
    public static final int MAX_ID_LENGTH = 64;

    /** The name of the Command, 1 to 128 characters. */
    public final String name;
    /** The fields as JSON values ({@link Json}); unmodifiable to their depth, not null. */
    public final Map<String, Object> data;
    /** The id for the requested answer, or null. */
    public final String id;
    /** The beacon, or null. */
    public final Long beacon;

    /** Creates a message without an id or a beacon. */
    public GeneralMessage(String name, Map<String, ?> data) {
        this(name, data, null, null);
    }

    /**
     * Creates a message; {@code data} null is an empty object, {@code id} null requests no answer,
     * {@code beacon} null is left out.
     */
    public GeneralMessage(String name, Map<String, ?> data, String id, Long beacon) {
        this(data == null ? Collections.emptyMap() : ImmutableCopy.map(data), name, id,
                beacon);
    }

    private GeneralMessage(Map<String, Object> frozenData, String name, String id, Long beacon) {
        this.name = name;
        data = frozenData;
        this.id = id;
        this.beacon = beacon;
    }

    /** Returns a message of the same data under another name, id and beacon. */
    public GeneralMessage with(String otherName, String otherId, Long otherBeacon) {
        return new GeneralMessage(data, otherName, otherId, otherBeacon);
    }

    /**
     * Parses one line, with or without its line end.
     *
     * @throws MalformedException when it is not a General Message; a beacon beyond 64 bits is
     *     malformed here
     */
    public static GeneralMessage read(byte[] line, int length) throws MalformedException {
        if (length > LineSplitter.MAX_LINE_BYTES) {
            throw new MalformedException("too_long",
                    "longer than " + LineSplitter.MAX_LINE_BYTES + " bytes");
        }
        String text = Utf8.decode(line, length);
        Object read;
        try {
            read = Json.parse(text);
        } catch (MalformedException fault) {
            throw new MalformedException(fault.code, fault.reason(), idDespiteFault(text));
        }
        if (!(read instanceof Map)) {
            throw new MalformedException("not_object", "not a JSON object");
        }
        return ofFields((Map<?, ?>) read);
    }

    /**
     * Returns the line with its LF.
     *
     * @throws IllegalArgumentException for what JSON cannot hold and for more than 16 KiB
     */
    public byte[] toLine() {
        Map<String, Object> fields = new LinkedHashMap<>();
        fields.put("name", name);
        fields.put("data", data);
        fields.put("id", id);
        if (beacon != null) {
            fields.put("beacon", beacon);
        }
        String text;
        try {
            text = Json.write(fields);
        } catch (IllegalArgumentException fault) {
            throw new IllegalArgumentException(name + ": " + fault.getMessage(), fault);
        }
        if (text.length() >= LineSplitter.MAX_LINE_BYTES) {
            throw new IllegalArgumentException(name + ": a line of " + (text.length() + 1)
                    + " bytes, at most " + LineSplitter.MAX_LINE_BYTES);
        }
        return Utf8.encode(text + "\n");
    }

    @SuppressWarnings("unchecked")
    private static GeneralMessage ofFields(Map<?, ?> fields) throws MalformedException {
        String id = readId(fields.get("id"));
        Object name = fields.get("name");
        if (!(name instanceof String) || !hasLength((String) name, MAX_NAME_LENGTH)) {
            throw new MalformedException("name",
                    "name must be text of 1 to " + MAX_NAME_LENGTH + " characters", id);
        }
        Object data = fields.get("data");
        if (data != null && !(data instanceof Map)) {
            throw new MalformedException("data", "data must be an object", id);
        }
        Object beacon = fields.get("beacon");
        if (beacon != null && !(beacon instanceof Long)) {
            throw new MalformedException("beacon", "beacon must be an integer of 64 bits",
                    id);
        }
        return new GeneralMessage((String) name, (Map<String, Object>) data, id, (Long) beacon);
    }

    /** Returns whether a text has 1 to {@code longest} characters. */
    private static boolean hasLength(String text, int longest) {
        int length = text.codePointCount(0, text.length());
        return length >= 1 && length <= longest;
    }

    /** Returns the id of a field, a text or a number that is taken as its text, or null. */
    private static String readId(Object value) throws MalformedException {
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
        if (text == null || !hasLength(text, MAX_ID_LENGTH)) {
            throw new MalformedException("id",
                    "id must be text of 1 to " + MAX_ID_LENGTH + " characters");
        }
        return text;
    }

    /** Returns the id of an object that breaks a rule but is JSON, so that it can be refused. */
    private static String idDespiteFault(String text) {
        try {
            Object fields = new JsonReader(text, false).read();
            String id = fields instanceof Map ? readId(((Map<?, ?>) fields).get("id")) : null;
            return id == null || Json.loneSurrogate(id) >= 0 ? null : id;
        } catch (MalformedException noJson) {
            // The error is already reported; the message merely has no id.
            return null;
        }
    }
}
