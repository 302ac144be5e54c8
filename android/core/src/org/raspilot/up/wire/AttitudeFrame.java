package org.raspilot.up.wire;

import java.nio.ByteBuffer;
import java.util.Arrays;
import java.util.LinkedHashMap;
import java.util.Map;

/**
 * A frame of telemetry as its key, older, with a new attitude; every other value keeps its true
 * age, or is unknown. Source: docs/protocols.md 6.
 */
final class AttitudeFrame {
    private static final int MARK = 7;
    private static final int BYTES = 13;
    private static final long AGE_STEP_MS = 150;
    private static final int NO_AGE = 15;
    private static final double ANGLE_STEPS = 10;
    private static final double VOLT_STEPS = 20;
    private static final String[] ANGLES = {"roll", "pitch", "yaw"};
    private static final String[] UNKNOWN = {"loop_us", "late_us", "frame_errors"};

    private AttitudeFrame() {
    }

    /** Returns whether data with that first byte, where deflate has a type of block, are one. */
    static boolean isType(byte first) {
        return (first & MARK) == MARK;
    }

    /** Returns the frame of the data from {@code at} on and their key. */
    static byte[] expand(byte[] key, byte[] body, int at) throws MalformedException {
        final GeneralMessage before = GeneralMessage.read(key, key.length);
        if (body.length != at + BYTES || body[at] != MARK || before.beacon == null) {
            throw new MalformedException("packed", "not an attitude frame");
        }
        final ByteBuffer data = ByteBuffer.wrap(body, at + 1, BYTES - 1);
        final int ages = data.get() & 0xff;
        final long beacon = before.beacon + (data.get() & 0xff);
        final int leftOut = data.get() & 0xff;
        final int clockMs = data.getShort() & 0xffff;
        final Map<String, Object> content = new LinkedHashMap<>(before.data);
        add(group(content, "uplink"), "left_out", leftOut);
        add(group(content, "system"), "clock_ms", clockMs);
        final Map<String, Object> agesMs = group(content, "age_ms");
        if (agesMs != null) {
            for (String reading : agesMs.keySet()) {
                add(agesMs, reading, clockMs);
            }
            agesMs.put("orientation", ageMs(ages >> 4));
            agesMs.put("flight", ageMs(ages & NO_AGE));
        }
        forget(group(content, "rates"), ANGLES);
        final Map<String, Object> board = group(content, "arduino");
        forget(board, UNKNOWN);
        final Map<String, Object> orientation = new LinkedHashMap<>();
        for (String angle : ANGLES) {
            orientation.put(angle, data.getShort() / ANGLE_STEPS);
        }
        final byte charge = data.get();
        final Number volts = number(board, "flight_battery_v");
        if (volts != null) {
            final double steps = Math.rint(volts.doubleValue() * VOLT_STEPS) + charge;
            board.put("flight_battery_v", steps / VOLT_STEPS);
        }
        content.put("orientation", orientation);
        final byte[] line;
        try {
            line = new GeneralMessage(before.name, content, before.id, beacon).toLine();
        } catch (IllegalArgumentException tooLong) {
            throw new MalformedException("packed", "too long");
        }
        return Arrays.copyOf(line, line.length - 1);
    }

    private static Long ageMs(int steps) {
        return steps == NO_AGE ? null : steps * AGE_STEP_MS;
    }

    /** Puts a copy of an object in its place and returns it; null: it is absent. */
    @SuppressWarnings("unchecked")
    private static Map<String, Object> group(Map<String, Object> content, String name) {
        if (!(content.get(name) instanceof Map)) {
            return null;
        }
        final Map<String, Object> copy =
                new LinkedHashMap<>((Map<String, Object>) content.get(name));
        content.put(name, copy);
        return copy;
    }

    private static Number number(Map<String, Object> group, String name) {
        final Object value = group == null ? null : group.get(name);
        return value instanceof Long || value instanceof Double ? (Number) value : null;
    }

    private static void add(Map<String, Object> group, String name, int more) {
        final Number value = number(group, name);
        if (value instanceof Long) {
            group.put(name, value.longValue() + more);
        } else if (value != null) {
            group.put(name, value.doubleValue() + more);
        }
    }

    private static void forget(Map<String, Object> group, String[] names) {
        for (String name : names) {
            if (number(group, name) != null) {
                group.put(name, null);
            }
        }
    }
}
