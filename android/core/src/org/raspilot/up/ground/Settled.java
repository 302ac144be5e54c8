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
final class Settled {
    private static final long FIRST_HOLD_MS = 3000;
    private static final long LONGEST_HOLD_MS = 30000;
    private static final long QUIET_MS = 60000;

    interface Teller {
        /** Called with the last reported value, null for the first, and the current one. */
        void tell(Object before, Object now);
    }

    private static final class Value {
        Object told;
        Object newest;
        Teller teller;
        long toldMs;
        long holdMs = FIRST_HOLD_MS;
    }

    private final Map<String, Value> values = new HashMap<>();

    /** Takes the current value, not null. */
    void take(String key, Object value, long nowMs, Teller teller) {
        final Value known = values.get(key);
        if (known == null) {
            final Value first = new Value();
            first.told = value;
            first.newest = value;
            first.teller = teller;
            first.toldMs = nowMs - QUIET_MS;
            values.put(key, first);
            teller.tell(null, value);
            return;
        }
        known.newest = value;
        known.teller = teller;
        tellIfDue(known, nowMs);
    }

    void onMoment(long nowMs) {
        for (Value each : new ArrayList<>(values.values())) {
            tellIfDue(each, nowMs);
        }
    }

    private static void tellIfDue(Value known, long nowMs) {
        final long restMs = nowMs - known.toldMs;
        if (known.newest.equals(known.told) || restMs < known.holdMs) {
            return;
        }
        known.holdMs = restMs >= QUIET_MS
                ? FIRST_HOLD_MS : Math.min(LONGEST_HOLD_MS, known.holdMs * 2);
        final Object before = known.told;
        known.told = known.newest;
        known.toldMs = nowMs;
        known.teller.tell(before, known.told);
    }
}
