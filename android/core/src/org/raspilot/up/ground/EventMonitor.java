package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;

/** Turns frames and link states into events and alarms: each change once; flapping rarely. */
final class EventMonitor {
    private final EventLog events;
    private final Alarms alarms;
    private final Map<TelemetryRule, Object> states = new HashMap<>();
    private final Set<TelemetryRule> wereThere = new HashSet<>();
    private Debouncer debouncer = new Debouncer();

    EventMonitor(EventLog events, Alarms alarms) {
        this.events = events;
        this.alarms = alarms;
    }

    /** Resets the state at another start of the link. */
    void reset() {
        debouncer = new Debouncer();
        states.clear();
        wereThere.clear();
        alarms.clear();
    }

    void onLink(GroundStatus status, long nowMs) {
        final Object state = Arrays.<Object>asList(status.isOpen(), status.isAircraftOnline);
        debouncer.update("link", state, nowMs, (before, now) -> {
            if (status.isOpen()) {
                add(status.isAircraftOnline == null ? "link_open" : status.isAircraftOnline
                        ? "aircraft_online" : "aircraft_offline", "", nowMs);
            } else if (before != null) {
                add("link_lost", ": " + status.reason, nowMs);
            }
        });
        if (!status.isDirect && status.isOpen() && status.control != ControlStatus.LATER) {
            debouncer.update("control", status.controlText(), nowMs, (before, now) ->
                    events.add(nowMs, EventLevel.INFO, "control_changed", now.toString()));
        }
    }

    /** Processes a frame, or the changes by time alone. */
    void update(Telemetry telemetry, GroundStatus status, long nowMs) {
        final List<Alarm> present = new ArrayList<>();
        // Before the first frame nothing went silent.
        if (telemetry != Telemetry.EMPTY && status.isSilent) {
            final TelemetryRule cause = TelemetrySchema.EVENTS.get(status.silenceCode());
            present.add(new Alarm("silent", EventLevel.ALARM, cause.code, cause.text));
        }
        final Alarms.Snapshot active = alarms.snapshot();
        for (TelemetryRule rule : TelemetrySchema.RULES) {
            final boolean isOver = !rule.alarmKind.isEmpty() && !active.has(rule.alarmKind);
            final Object state = rule.state(telemetry, isOver ? null : states.get(rule));
            if (state == null) {
                continue;
            }
            states.put(rule, state);
            if (Boolean.FALSE.equals(state)) {
                wereThere.add(rule);
            }
            final Alarm alarm = rule.alarm(state, telemetry, wereThere.contains(rule));
            if (alarm != null) {
                present.add(alarm);
            }
            if (rule.isEvent) {
                debouncer.update(rule.path + " " + rule.code, state, nowMs, (before, now) ->
                        rule.report(before, now, telemetry, events, nowMs));
            }
        }
        debouncer.onTick(nowMs);
        if (alarms.update(present, nowMs)) {
            debouncer.update("silent", alarms.snapshot().has("silent"), nowMs, (before, now) -> {
                if (Boolean.TRUE.equals(now)) {
                    add(status.silenceCode(), "", nowMs);
                } else if (before != null) {
                    add("heard", "", nowMs);
                }
            });
        }
    }

    /** Adds an event of the link; {@code reason} follows its text. */
    void add(String code, String reason, long nowMs) {
        final TelemetryRule event = TelemetrySchema.EVENTS.get(code);
        events.add(nowMs, event.level, code, event.text + reason);
    }
}
