package org.raspilot.up.ground;

import java.util.Arrays;

/** Turns frames and link states into events: each change once, in plain words; flapping rarely. */
final class EventMonitor {
    private final EventLog events;
    private final Alarms alarms;
    private Debouncer settled = new Debouncer();

    EventMonitor(EventLog events, Alarms alarms) {
        this.events = events;
        this.alarms = alarms;
    }

    /** Resets the state at another start of the link. */
    void reset() {
        settled = new Debouncer();
        alarms.clear();
    }

    void onFrame(Telemetry telemetry, GroundStatus status, final long nowMs) {
        for (final EventRule fact : EventRules.ALL) {
            final Object value = fact.read(telemetry);
            if (value != null) {
                settled.update(fact.key, value, nowMs, (before, now) -> {
                    final String words = fact.words(before, now);
                    if (words != null) {
                        events.add(nowMs, fact.level(before, now), fact.kind, words);
                    }
                });
            }
        }
        onTick(telemetry, status, nowMs);
    }

    void onLink(final GroundStatus status, final long nowMs) {
        final Object state = Arrays.<Object>asList(status.isOpen(), status.isAircraftOnline);
        settled.update("link", state, nowMs, (before, now) ->
                noteLink(status, before == null, nowMs));
        if (!status.isDirect && status.isOpen() && status.control != ControlStatus.LATER) {
            settled.update("seat", status.controlText(), nowMs, (before, now) ->
                    events.add(nowMs, EventLevel.INFO, "link", now.toString()));
        }
    }

    /** Evaluates changes due to time alone. */
    void onTick(Telemetry telemetry, GroundStatus status, long nowMs) {
        settled.onTick(nowMs);
        if (alarms.update(telemetry, status, nowMs)) {
            updateAlarm(Alarm.Kind.SILENT, "link", EventLevel.ALARM, status.isLate
                    ? "telemetry comes too late" : "no telemetry any more",
                    "telemetry comes again", nowMs);
            updateAlarm(Alarm.Kind.BATTERY, "battery", EventLevel.WARNING,
                    "the phone's battery is low", "the phone's battery is charged", nowMs);
        }
    }

    private void updateAlarm(Alarm.Kind alarm, final String kind, final EventLevel level,
            final String gone, final String back, final long nowMs) {
        final boolean isOn = alarms.snapshot().has(alarm);
        settled.update("alarm " + alarm, isOn, nowMs, (before, now) -> {
            if (Boolean.TRUE.equals(now)) {
                events.add(nowMs, level, kind, gone);
            } else if (before != null) {
                events.add(nowMs, EventLevel.INFO, kind, back);
            }
        });
    }

    private void noteLink(GroundStatus status, boolean isFirst, long nowMs) {
        if (!status.isOpen()) {
            if (!isFirst) {
                events.add(nowMs, EventLevel.WARNING, "link",
                        "the link is gone: " + status.reason);
            }
        } else if (Boolean.FALSE.equals(status.isAircraftOnline)) {
            events.add(nowMs, EventLevel.WARNING, "link",
                    "the aircraft is not connected to the proxy");
        } else {
            events.add(nowMs, EventLevel.INFO, "link", status.isAircraftOnline == null
                    ? "the link is there" : "the aircraft is connected");
        }
    }
}
