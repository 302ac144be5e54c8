package org.raspilot.up.ground;

import java.util.Collections;
import java.util.HashMap;
import java.util.Locale;
import java.util.Map;
import java.util.Set;

/**
 * The age of a frame of telemetry and of each of its readings: on the aircraft, in transit, and
 * since reception. Immutable; pass {@code nowMs} of the loop that received the frame, on any
 * thread.
 */
public final class Age {
    private final boolean isKnown;
    public final boolean isLinkLost;
    private final long receivedMs;
    /** The known part of the frame's transit time, ms. */
    public final long transitMs;
    private final Map<String, Double> onBoardMs;

    private Age(boolean isKnown, boolean isLinkLost, long receivedMs, long wayMs,
            Map<String, Double> onBoardMs) {
        this.isKnown = isKnown;
        this.isLinkLost = isLinkLost;
        this.receivedMs = receivedMs;
        this.transitMs = wayMs;
        this.onBoardMs = onBoardMs;
    }

    /** Returns the age for telemetry that never arrived: everything is stale. */
    static Age unknown() {
        return new Age(false, true, 0, 0, Collections.emptyMap());
    }

    /** Returns the age of a frame with the known ages of readings when it was made. */
    static Age ofFrame(long receivedMs, long wayMs, Map<String, Double> onBoardMs) {
        final Map<String, Double> copy = new HashMap<>(onBoardMs);
        return new Age(true, false, receivedMs, Math.max(0, wayMs), copy);
    }

    Age withTransit(long anotherMs) {
        return new Age(isKnown, isLinkLost, receivedMs, Math.max(0, anotherMs), onBoardMs);
    }

    /** Returns the same age after the link was lost: everything is stale from now on. */
    Age withLostLink() {
        return new Age(isKnown, true, receivedMs, transitMs, onBoardMs);
    }

    /** Returns the age of the frame including transit, ms; null without a frame. */
    public Long frameMs(long nowMs) {
        return isKnown ? Long.valueOf(Math.max(0, nowMs - receivedMs) + transitMs) : null;
    }

    /**
     * Returns the age of a reading, ms: on the aircraft, in transit and since; null: unknown.
     *
     * @param reading {@code orientation rx servo flight location altitude heading battery}
     */
    public Long readingMs(String reading, long nowMs) {
        final Long frame = frameMs(nowMs);
        final Double there = onBoardMs.get(reading);
        if (frame == null || there == null) {
            return null;
        }
        return frame + Math.round(Math.max(0.0, there));
    }

    /** Returns the names of the readings that become stale. */
    public static Set<String> readings() {
        return Collections.unmodifiableSet(TelemetrySchema.STALE_MS.keySet());
    }

    /** Returns whether the frame is too old for any of its values to be current. */
    public boolean isSilent(long nowMs) {
        final Long frame = frameMs(nowMs);
        return isLinkLost || frame == null || frame > TelemetrySchema.SILENT_MS;
    }

    /** Returns whether frames arrive, but so late that they count as silence. */
    public boolean isLate(long nowMs) {
        return isKnown && !isLinkLost && transitMs > TelemetrySchema.SILENT_MS
                && nowMs - receivedMs <= TelemetrySchema.SILENT_MS;
    }

    /** Returns whether a reading is too old to fly by; a reading without an age has its frame's. */
    public boolean isStale(String reading, long nowMs) {
        if (isSilent(nowMs)) {
            return true;
        }
        final Long age = readingMs(reading, nowMs);
        final Long limit = TelemetrySchema.STALE_MS.get(reading);
        return age != null && age > (limit == null ? TelemetrySchema.SILENT_MS : limit);
    }

    /** Returns for how long something has been so: whole seconds, as hundredths would only flicker. */
    public static String agoText(long agoMs) {
        final long wholeMs = Math.max(0, agoMs) / 1000 * 1000;
        return wholeMs < 100000 ? wholeMs / 1000 + " s" : text(wholeMs);
    }

    /**
     * Returns an age in at most six characters: {@code 0.03 s}, {@code 12.4 s}, {@code 3 min},
     * {@code 2 h}, {@code days}; null is {@code --}.
     */
    public static String text(Long ageMs) {
        if (ageMs == null) {
            return "--";
        }
        final double seconds = Math.max(0, ageMs) / 1000.0;
        if (seconds < 9.995) {
            return String.format(Locale.ROOT, "%.2f s", seconds);
        }
        if (seconds < 99.95) {
            return String.format(Locale.ROOT, "%.1f s", seconds);
        }
        if (seconds < 3600) {
            return Math.round(seconds / 60) + " min";
        }
        return seconds < 360000 ? Math.round(seconds / 3600) + " h" : "days";
    }
}
