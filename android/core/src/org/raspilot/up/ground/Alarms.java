package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Collections;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;

/**
 * The active alarms: each starts immediately and ends some time after its cause. Only on the
 * loop.
 */
public final class Alarms {
    /** The airborne phone's battery is low below this, percent. */
    public static final double BATTERY_LOW = 20;
    /** The airborne phone's battery is nearly empty below this, percent. */
    public static final double BATTERY_EMPTY = 10;

    private static final double BATTERY_BACK = 3;

    /** A snapshot of the alarms. Immutable. */
    public static final class Snapshot {
        /** A number that rises with each change. */
        public final long version;
        /** The alarms that are on, by kind, unmodifiable. */
        public final List<Alarm> active;

        Snapshot(long version, List<Alarm> active) {
            this.version = version;
            this.active = active;
        }

        /** Returns whether an active alarm should sound and vibrate. */
        public boolean isLoud() {
            for (Alarm each : active) {
                if (each.isLoud()) {
                    return true;
                }
            }
            return false;
        }

        /** Returns whether an alarm of that kind is active. */
        public boolean has(Alarm.Kind kind) {
            for (Alarm each : active) {
                if (each.kind == kind) {
                    return true;
                }
            }
            return false;
        }
    }

    private final Map<Alarm.Kind, Long> causeMs = new EnumMap<>(Alarm.Kind.class);
    private final Map<Alarm.Kind, Alarm> known = new EnumMap<>(Alarm.Kind.class);
    private boolean hadBoard;
    private Snapshot snapshot = new Snapshot(0, Collections.emptyList());

    Alarms() {
    }

    public Snapshot snapshot() {
        return snapshot;
    }

    /** Ends all alarms: monitoring of the aircraft has ended. */
    void clear() {
        causeMs.clear();
        known.clear();
        hadBoard = false;
        publish();
    }

    /** Updates the alarms; returns whether they changed. */
    boolean update(Telemetry telemetry, GroundStatus status, long nowMs) {
        hadBoard = hadBoard || Boolean.TRUE.equals(EventRule.board(telemetry));
        for (Alarm each : find(telemetry, status)) {
            known.put(each.kind, each);
            causeMs.put(each.kind, nowMs);
        }
        for (Alarm.Kind kind : Alarm.Kind.values()) {
            final Long lastMs = causeMs.get(kind);
            if (lastMs != null && nowMs - lastMs >= holdMs(kind)) {
                causeMs.remove(kind);
                known.remove(kind);
            }
        }
        return publish();
    }

    private static long holdMs(Alarm.Kind kind) {
        for (BoardAlarm each : BoardSchema.ALARMS) {
            if (each.kind == kind) {
                return each.holdMs;
            }
        }
        return BoardSchema.ALARM_HOLD_MS;
    }

    private boolean publish() {
        final List<Alarm> active = new ArrayList<>(known.values());
        if (active.equals(snapshot.active)) {
            return false;
        }
        snapshot = new Snapshot(snapshot.version + 1, Collections.unmodifiableList(active));
        return true;
    }

    private List<Alarm> find(Telemetry telemetry, GroundStatus status) {
        final List<Alarm> found = new ArrayList<>();
        // Before the first frame nothing went silent.
        if (telemetry != Telemetry.EMPTY && status.isSilent) {
            found.add(new Alarm(Alarm.Kind.SILENT, EventLevel.ALARM, silence(status)));
        }
        for (BoardAlarm each : BoardSchema.ALARMS) {
            final Alarm alarm = each.alarm(telemetry);
            if (alarm != null) {
                found.add(alarm);
            }
        }
        if (EventRule.NOT_YET.equals(EventRule.board(telemetry)) && !hadBoard) {
            found.add(new Alarm(Alarm.Kind.BOARD, EventLevel.WARNING,
                    "the board is not here yet"));
        } else if (isFalse(telemetry, "arduino.connected")) {
            found.add(new Alarm(Alarm.Kind.BOARD, EventLevel.ALARM, "the board is gone"));
        }
        if (Boolean.FALSE.equals(EventRule.phone(telemetry))) {
            found.add(new Alarm(Alarm.Kind.PHONE, EventLevel.WARNING, "the phone is gone"));
        }
        final Double percent = telemetry.number("android.batteryLevel");
        final double low = BATTERY_LOW
                + (known.containsKey(Alarm.Kind.BATTERY) ? BATTERY_BACK : 0);
        if (percent != null && percent < low) {
            final boolean isEmpty = percent < BATTERY_EMPTY;
            found.add(new Alarm(Alarm.Kind.BATTERY,
                    isEmpty ? EventLevel.ALARM : EventLevel.WARNING,
                    "the phone's battery is " + (isEmpty ? "nearly empty" : "low")));
        }
        return found;
    }

    /** The text is constant while the cause lasts: an alarm must not blink with each attempt. */
    private static String silence(GroundStatus status) {
        if (!status.isOpen()) {
            return "no link";
        }
        if (Boolean.FALSE.equals(status.isAircraftOnline)) {
            return "the aircraft is not connected to the proxy";
        }
        return status.isLate ? "telemetry comes too late" : "the aircraft is silent";
    }

    private static boolean isFalse(Telemetry telemetry, String path) {
        return Boolean.FALSE.equals(telemetry.flag(path));
    }
}
