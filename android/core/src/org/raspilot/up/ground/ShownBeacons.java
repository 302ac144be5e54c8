package org.raspilot.up.ground;

import java.util.ArrayDeque;
import java.util.Iterator;

/** The beacons of received telemetry: whether the one that the pilot has seen is fresh. */
final class ShownBeacons {
    /** A beacon that the aircraft sent longer ago, ms, is stale (docs/protocols.md 4)... */
    private static final long FRESH_MS = 2000;
    /** ...unless the period of telemetry plus this transit time is longer. */
    private static final long WAY_MS = 1000;
    /** More frames than this while a beacon is fresh come from no aircraft. */
    private static final int MAX_BEACONS = 512;

    private static final class Heard {
        final long beacon;
        final long sentMs;

        Heard(long beacon, long sentMs) {
            this.beacon = beacon;
            this.sentMs = sentMs;
        }
    }

    private final ArrayDeque<Heard> heard = new ArrayDeque<>();
    private boolean hasFrames;
    private boolean hasBeacons;
    private long limitMs = FRESH_MS;

    /** Remembers a frame's beacon; null: it has none. */
    void onFrame(Telemetry frame) {
        hasFrames = true;
        final Double periodMs = frame.number("system.period_ms");
        limitMs = periodMs == null ? FRESH_MS
                : Math.max(FRESH_MS, Math.round(periodMs) + WAY_MS);
        if (frame.beacon == null) {
            return;
        }
        hasBeacons = true;
        heard.add(new Heard(frame.beacon, frame.receivedMs - frame.age.transitMs));
        if (heard.size() > MAX_BEACONS) {
            heard.remove();
        }
    }

    /** Clears all beacons: frames of another connection must be seen again. */
    void onLost() {
        heard.clear();
        hasFrames = false;
        hasBeacons = false;
    }

    /** Returns the beacon of the newest frame, seen or not; null: none. */
    Long newest() {
        return heard.isEmpty() ? null : Long.valueOf(heard.peekLast().beacon);
    }

    /** Returns whether telemetry arrives without beacons, as the thesis's does. */
    boolean isLegacy() {
        return hasFrames && !hasBeacons;
    }

    boolean isFresh(Long beacon, long nowMs) {
        final Heard found = find(beacon);
        return found != null && nowMs - found.sentMs <= limitMs;
    }

    /** Returns the age, ms, from which on a beacon is stale now. */
    long limitMs() {
        return limitMs;
    }

    private Heard find(Long beacon) {
        if (beacon == null) {
            return null;
        }
        // The newest first: a hostile aircraft may repeat a beacon.
        final Iterator<Heard> each = heard.descendingIterator();
        while (each.hasNext()) {
            final Heard found = each.next();
            if (found.beacon == beacon) {
                return found;
            }
        }
        return null;
    }
}
