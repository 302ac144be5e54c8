package org.raspilot.up.wire;

import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.Map;

/**
 * One General Message: which Command, its fields, and what asks for an answer or tells freshness.
 *
 * <p>Source: docs/protocols.md 4, thesis 3.1.4.
 */
public final class GeneralMessage {
    /** Characters of the longest name. */
    public static final int LONGEST_NAME = 128;
    /** Characters of the longest id. */
    public static final int LONGEST_ID = 64;

    private final String name;
    private final Map<String, Object> data;
    private final String id;
    private final Long beacon;

    /** Makes a message that wants no answer and carries no beacon. */
    public GeneralMessage(String name, Map<String, ?> data) {
        this(name, data, null, null);
    }

    /**
     * Makes a message; {@code data} null is an empty object, {@code id} null wants no answer,
     * {@code beacon} null is left out.
     */
    public GeneralMessage(String name, Map<String, ?> data, String id, Long beacon) {
        this.name = name;
        this.data = data == null
                ? Collections.<String, Object>emptyMap()
                : Collections.unmodifiableMap(new LinkedHashMap<String, Object>(data));
        this.id = id;
        this.beacon = beacon;
    }

    /** Returns the name of the Command, 1 to 128 characters. */
    public String name() {
        return name;
    }

    /** Returns the fields as JSON values (see {@link Json}); unmodifiable, never null. */
    public Map<String, Object> data() {
        return data;
    }

    /** Returns the id under which an answer is asked for, or null. */
    public String id() {
        return id;
    }

    /** Returns the beacon, or null. */
    public Long beacon() {
        return beacon;
    }

    /**
     * Reads one line, with or without its line end.
     *
     * @throws MalformedException when it is no General Message
     */
    public static GeneralMessage read(byte[] line, int length) throws MalformedException {
        throw new MalformedException("not JSON");
    }

    /**
     * Returns the line with its LF.
     *
     * @throws IllegalArgumentException for what JSON cannot hold and for more than 16 KiB
     */
    public byte[] toLine() {
        return new byte[0];
    }
}
