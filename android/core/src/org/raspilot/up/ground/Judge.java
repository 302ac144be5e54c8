package org.raspilot.up.ground;

import java.util.Arrays;

/** Turns frames and link states into events: each change once, in plain words; flapping rarely. */
final class Judge {
    private final EventLog events;
    private final Alarms alarms;
    private Settled settled = new Settled();

    Judge(EventLog events, Alarms alarms) {
        this.events = events;
        this.alarms = alarms;
    }

    /** Resets the state at another start of the link. */
    void forget() {
        settled = new Settled();
        alarms.clear();
    }

    void onFrame(Telemetry telemetry, GroundStatus status, final long nowMs) {
        for (final Fact fact : Facts.ALL) {
            final Object value = fact.read(telemetry);
            if (value != null) {
                settled.take(fact.key, value, nowMs, (before, now) -> {
                    final String words = fact.words(before, now);
                    if (words != null) {
                        events.note(nowMs, fact.level(before, now), fact.kind, words);
                    }
                });
            }
        }
        onMoment(telemetry, status, nowMs);
    }

    void onLink(final GroundStatus status, final long nowMs) {
        final Object state = Arrays.<Object>asList(status.isOpen(), status.isAircraftOnline);
        settled.take("link", state, nowMs, (before, now) ->
                onLinkTold(status, before == null, nowMs));
        if (!status.isDirect && status.isOpen() && status.standing != SeatStanding.LATER) {
            settled.take("seat", status.seatSentence(), nowMs, (before, now) ->
                    events.note(nowMs, EventLevel.INFO, "link", now.toString()));
        }
    }

    /** Evaluates changes due to time alone. */
    void onMoment(Telemetry telemetry, GroundStatus status, long nowMs) {
        settled.onMoment(nowMs);
        if (alarms.take(telemetry, status, nowMs)) {
            say(Alarm.Kind.SILENT, "link", EventLevel.ALARM, status.isLate
                    ? "telemetry comes too late" : "no telemetry any more",
                    "telemetry comes again", nowMs);
            say(Alarm.Kind.BATTERY, "battery", EventLevel.WARNING,
                    "the phone's battery is low", "the phone's battery is charged", nowMs);
        }
    }

    private void say(Alarm.Kind alarm, final String kind, final EventLevel level,
            final String gone, final String back, final long nowMs) {
        final boolean isOn = alarms.snapshot().has(alarm);
        settled.take("alarm " + alarm, isOn, nowMs, (before, now) -> {
            if (Boolean.TRUE.equals(now)) {
                events.note(nowMs, level, kind, gone);
            } else if (before != null) {
                events.note(nowMs, EventLevel.INFO, kind, back);
            }
        });
    }

    private void onLinkTold(GroundStatus status, boolean isFirst, long nowMs) {
        if (!status.isOpen()) {
            if (!isFirst) {
                events.note(nowMs, EventLevel.WARNING, "link",
                        "the link is gone: " + status.reason);
            }
        } else if (Boolean.FALSE.equals(status.isAircraftOnline)) {
            events.note(nowMs, EventLevel.WARNING, "link",
                    "the aircraft is not connected to the proxy");
        } else {
            events.note(nowMs, EventLevel.INFO, "link", status.isAircraftOnline == null
                    ? "the link is there" : "the aircraft is connected");
        }
    }
}
