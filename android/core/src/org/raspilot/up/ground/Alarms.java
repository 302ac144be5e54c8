package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Collections;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/**
 * The active alarms: each starts immediately and ends some time after its cause. Only on the
 * loop.
 */
public final class Alarms {
    /** A snapshot of the alarms. Immutable. */
    public static final class Snapshot {
        public final long version;
        /** The alarms that are on, by kind, unmodifiable. */
        public final List<Alarm> active;

        Snapshot(long version, List<Alarm> active) {
            this.version = version;
            this.active = active;
        }

        public boolean has(String kind) {
            for (Alarm each : active) {
                if (each.kind.equals(kind)) {
                    return true;
                }
            }
            return false;
        }
    }

    private final Map<String, Long> causeMs = new HashMap<>();
    private final Map<String, Alarm> known = new HashMap<>();
    private Snapshot snapshot = new Snapshot(0, Collections.emptyList());

    Alarms() {
    }

    public static double limit(String code) {
        return TelemetrySchema.LIMITS.get(code);
    }

    public Snapshot snapshot() {
        return snapshot;
    }

    /** Ends all alarms: monitoring of the aircraft has ended. */
    void clear() {
        causeMs.clear();
        known.clear();
        publish();
    }

    /** Updates the alarms to the present ones; returns whether they changed. */
    boolean update(List<Alarm> present, long nowMs) {
        for (Alarm each : present) {
            known.put(each.kind, each);
            causeMs.put(each.kind, nowMs);
        }
        for (Map.Entry<String, Long> each : TelemetrySchema.HOLDS_MS.entrySet()) {
            final Long lastMs = causeMs.get(each.getKey());
            if (lastMs != null && nowMs - lastMs >= each.getValue()) {
                causeMs.remove(each.getKey());
                known.remove(each.getKey());
            }
        }
        return publish();
    }

    private boolean publish() {
        final List<Alarm> active = new ArrayList<>();
        for (String kind : TelemetrySchema.HOLDS_MS.keySet()) {
            if (known.containsKey(kind)) {
                active.add(known.get(kind));
            }
        }
        if (active.equals(snapshot.active)) {
            return false;
        }
        snapshot = new Snapshot(snapshot.version + 1, Collections.unmodifiableList(active));
        return true;
    }
}
