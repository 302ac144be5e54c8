package org.raspilot.up.ground;

import java.util.Arrays;

/** Turns frames and link states into events: each change once, in plain words; flapping rarely. */
final class EventMonitor {
    private final EventLog events;
    private final Alarms alarms;
    private Debouncer debouncer = new Debouncer();

    EventMonitor(EventLog events, Alarms alarms) {
        this.events = events;
        this.alarms = alarms;
    }

    /** Resets the state at another start of the link. */
    void reset() {
        debouncer = new Debouncer();
        alarms.clear();
    }

    void onFrame(Telemetry telemetry, GroundStatus status, long nowMs) {
        for (EventRule rule : EventRule.ALL) {
            final Object value = rule.reader.read(telemetry);
            if (value != null) {
                debouncer.update(rule.key, value, nowMs, (before, now) -> {
                    final EventRule.Change change = rule.describer.describe(before, now);
                    if (change != null) {
                        events.add(nowMs, change.level, change.code, change.text);
                    }
                });
            }
        }
        onTick(telemetry, status, nowMs);
    }

    void onLink(GroundStatus status, long nowMs) {
        final Object state = Arrays.<Object>asList(status.isOpen(), status.isAircraftOnline);
        debouncer.update("link", state, nowMs, (before, now) ->
                noteLink(status, before == null, nowMs));
        if (!status.isDirect && status.isOpen() && status.control != ControlStatus.LATER) {
            debouncer.update("control", status.controlText(), nowMs, (before, now) ->
                    events.add(nowMs, EventLevel.INFO, "control_changed", now.toString()));
        }
    }

    /** Evaluates changes due to time alone. */
    void onTick(Telemetry telemetry, GroundStatus status, long nowMs) {
        debouncer.onTick(nowMs);
        if (alarms.update(telemetry, status, nowMs)) {
            updateAlarm(Alarm.Kind.SILENT, EventLevel.ALARM,
                    status.isLate ? "telemetry_late" : "telemetry_lost",
                    status.isLate ? "telemetry comes too late" : "telemetry lost",
                    "telemetry_received", "telemetry is received again", nowMs);
            updateAlarm(Alarm.Kind.BATTERY, EventLevel.WARNING,
                    "phone_battery_low", "the phone's battery is low",
                    "phone_battery_charged", "the phone's battery is charged", nowMs);
        }
    }

    private void updateAlarm(Alarm.Kind alarm, EventLevel level, String onCode, String onText,
            String offCode, String offText, long nowMs) {
        debouncer.update("alarm " + alarm, alarms.snapshot().has(alarm), nowMs, (before, now) -> {
            if (Boolean.TRUE.equals(now)) {
                events.add(nowMs, level, onCode, onText);
            } else if (before != null) {
                events.add(nowMs, EventLevel.INFO, offCode, offText);
            }
        });
    }

    private void noteLink(GroundStatus status, boolean isFirst, long nowMs) {
        if (!status.isOpen()) {
            if (!isFirst) {
                events.add(nowMs, EventLevel.WARNING, "link_lost",
                        "link lost: " + status.reason);
            }
        } else if (Boolean.FALSE.equals(status.isAircraftOnline)) {
            events.add(nowMs, EventLevel.WARNING, "aircraft_offline",
                    "the aircraft is not connected to the proxy");
        } else {
            final boolean isKnown = status.isAircraftOnline != null;
            events.add(nowMs, EventLevel.INFO, isKnown ? "aircraft_online" : "link_open",
                    isKnown ? "the aircraft is connected" : "link open");
        }
    }
}
