package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.Map;

/**
 * Reports a change immediately, and the next one of the same key only after a growing pause.
 *
 * <p>A flapping value is reported with its newest value, in the long run twice a minute. The first
 * value of a key is reported with null as the previous value.
 */
final class Debouncer {
    interface ChangeListener {
        /** Called with the last reported value, null for the first, and the current one. */
        void onChange(Object before, Object now);
    }

    private static final class Value {
        Object told;
        Object newest;
        ChangeListener teller;
        long reportedMs;
        long holdMs = TelemetrySchema.PAUSE_MS;
    }

    private final Map<String, Value> values = new HashMap<>();

    /** Takes the current value, not null. */
    void update(String key, Object value, long nowMs, ChangeListener teller) {
        final Value known = values.get(key);
        if (known == null) {
            final Value first = new Value();
            first.told = value;
            first.newest = value;
            first.teller = teller;
            first.reportedMs = nowMs - TelemetrySchema.QUIET_MS;
            values.put(key, first);
            teller.onChange(null, value);
            return;
        }
        known.newest = value;
        known.teller = teller;
        reportIfDue(known, nowMs);
    }

    void onTick(long nowMs) {
        for (Value each : new ArrayList<>(values.values())) {
            reportIfDue(each, nowMs);
        }
    }

    private static void reportIfDue(Value known, long nowMs) {
        final long restMs = nowMs - known.reportedMs;
        if (known.newest.equals(known.told) || restMs < known.holdMs) {
            return;
        }
        known.holdMs = restMs >= TelemetrySchema.QUIET_MS
                ? TelemetrySchema.PAUSE_MS : Math.min(TelemetrySchema.MAX_PAUSE_MS, known.holdMs * 2);
        final Object before = known.told;
        known.told = known.newest;
        known.reportedMs = nowMs;
        known.teller.onChange(before, known.told);
    }
}
