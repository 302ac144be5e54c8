package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.wire.ImmutableCopy;
import org.raspilot.up.wire.SafeText;

/**
 * One frame of telemetry, read defensively: a field of a wrong type counts as unknown.
 *
 * <p>Immutable and thread-safe. Paths are keys joined by dots, as {@code orientation.roll}; units
 * are those of docs/protocols.md 6. Source: thesis 4.1.5.
 */
public final class Telemetry {
    public static final String NAME = "up.telemetry.update";
    /** The state before the first frame: empty, and everything stale. */
    public static final Telemetry EMPTY = new Telemetry(
            Collections.emptyMap(), null, 0, Age.unknown());

    private static final double MAX_NUMBER = 1e12;
    private static final int SHORT_TEXT = 40;
    private static final int MAX_TEXTS = 32;
    private static final int MAX_LISTED_TEXT_LENGTH = 80;

    /** All fields as JSON values, unmodifiable at each depth. */
    public final Map<String, Object> tree;
    /** The aircraft's number of the frame; null: it has none. */
    public final Long beacon;
    /** The loop's clock when it came, ms. */
    public final long receivedMs;
    public final Age age;

    private Telemetry(Map<String, Object> tree, Long beacon, long receivedMs, Age age) {
        this.tree = tree;
        this.beacon = beacon;
        this.receivedMs = receivedMs;
        this.age = age;
    }

    /**
     * Creates a frame of JSON values, which are copied; {@code wayMs}: the known part of the
     * transit time.
     */
    public static Telemetry of(Map<String, ?> data, Long beacon, long receivedMs, long wayMs) {
        final Map<String, Object> tree = ImmutableCopy.map(data);
        final Telemetry bare = new Telemetry(tree, beacon, receivedMs, Age.unknown());
        final Map<String, Double> ages = new LinkedHashMap<>();
        final Map<String, Object> told = bare.object("age_ms");
        if (told != null) {
            for (Map.Entry<String, Object> each : told.entrySet()) {
                final Double ageMs = number(each.getValue());
                if (ageMs != null) {
                    ages.put(each.getKey(), ageMs);
                }
            }
        }
        return new Telemetry(tree, beacon, receivedMs, Age.ofFrame(receivedMs, wayMs, ages));
    }

    /** Returns the same frame with another transit time. */
    Telemetry withTransit(long wayMs) {
        return new Telemetry(tree, beacon, receivedMs, age.withTransit(wayMs));
    }

    /** Returns the same frame after its link was lost: everything in it is stale. */
    Telemetry withLostLink() {
        return new Telemetry(tree, beacon, receivedMs, age.withLostLink());
    }

    /** Returns whether the value at a path may be flown by now. */
    public Freshness freshness(String path, long nowMs) {
        if (at(path) == null) {
            return Freshness.NONE;
        }
        return age.isStale(readingOf(path), nowMs) ? Freshness.STALE : Freshness.LIVE;
    }

    /** Returns the reading at a path, or whose age its value has; null: it has its frame's. */
    public static String readingOf(String path) {
        return TelemetrySchema.STALE_MS.containsKey(path) ? path
                : TelemetrySchema.READING_OF.get(path);
    }

    /** Returns the finite number at a path; null if absent, null or of another type. */
    public Double number(String path) {
        return number(at(path));
    }

    /** Returns true or false at a path; null: not known. */
    public Boolean flag(String path) {
        final Object found = at(path);
        return found instanceof Boolean ? (Boolean) found : null;
    }

    /** Returns the text at a path, of at most 40 characters, safe to show; null: not known. */
    public String text(String path) {
        return text(path, SHORT_TEXT);
    }

    /** Returns the text at a path, of at most {@code limit} characters; null: not known. */
    public String text(String path, int limit) {
        final Object found = at(path);
        return found instanceof String ? SafeText.of((String) found, limit) : null;
    }

    /** Returns the texts of a list, safe to display, at most 32, or null if absent. */
    public List<String> texts(String path) {
        final List<Object> found = list(path);
        if (found == null) {
            return null;
        }
        final List<String> texts = new ArrayList<>();
        for (Object each : found) {
            if (each instanceof String && texts.size() < MAX_TEXTS) {
                texts.add(SafeText.of((String) each, MAX_LISTED_TEXT_LENGTH));
            }
        }
        return Collections.unmodifiableList(texts);
    }

    /** Returns the list at a path as received, unmodifiable, or null if absent. */
    @SuppressWarnings("unchecked")
    public List<Object> list(String path) {
        final Object found = at(path);
        return found instanceof List ? (List<Object>) found : null;
    }

    /** Returns the object at a path as received, unmodifiable, or null if absent. */
    @SuppressWarnings("unchecked")
    public Map<String, Object> object(String path) {
        final Object found = at(path);
        return found instanceof Map ? (Map<String, Object>) found : null;
    }

    private Object at(String path) {
        Object found = tree;
        int begin = 0;
        while (begin <= path.length()) {
            final int dot = path.indexOf('.', begin);
            final int end = dot < 0 ? path.length() : dot;
            if (!(found instanceof Map)) {
                return null;
            }
            found = ((Map<?, ?>) found).get(path.substring(begin, end));
            begin = end + 1;
        }
        return found;
    }

    private static Double number(Object found) {
        if (!(found instanceof Number)) {
            return null;
        }
        final double value = ((Number) found).doubleValue();
        // Written so that NaN is refused, too.
        return Math.abs(value) < MAX_NUMBER ? Double.valueOf(value) : null;
    }
}
