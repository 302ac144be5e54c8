package org.raspilot.up.ground;

import java.util.Collections;
import java.util.List;

/**
 * The alarms that are on: one begins at once and ends {@link #OVER_MS} after its cause. Only on
 * the loop.
 */
public final class Alarms {
    /** An alarm ends when its cause has been away for so long, ms. */
    public static final long OVER_MS = 2000;

    /** The alarms of a moment. Immutable. */
    public static final class Snapshot {
        private final long version;
        private final List<Alarm> active;

        Snapshot(long version, List<Alarm> active) {
            this.version = version;
            this.active = active;
        }

        /** Returns a number that rises with each change. */
        public long version() {
            return version;
        }

        /** Returns the alarms that are on, by kind, unmodifiable. */
        public List<Alarm> active() {
            return active;
        }

        /** Says whether one of them should sound and vibrate. */
        public boolean isLoud() {
            for (Alarm each : active) {
                if (each.isLoud()) {
                    return true;
                }
            }
            return false;
        }

        /** Says whether an alarm of that kind is on. */
        public boolean has(Alarm.Kind kind) {
            for (Alarm each : active) {
                if (each.kind() == kind) {
                    return true;
                }
            }
            return false;
        }
    }

    private Snapshot snapshot = new Snapshot(0, Collections.<Alarm>emptyList());

    /** Returns the alarms of now. */
    public Snapshot snapshot() {
        return snapshot;
    }
}
