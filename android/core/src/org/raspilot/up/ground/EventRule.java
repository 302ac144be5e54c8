package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.List;

/** A value of telemetry whose changes are events. */
final class EventRule {
    /** Not connected and without a reading so far, which is not a loss. */
    static final String NOT_YET = "not yet";
    private static final int AFTER_ARMED = 4;
    static final List<EventRule> ALL = all(
            named("flight_mode", "flight_mode", "flight mode", EventLevel.INFO),
            named("mode", "mode", "mode", EventLevel.INFO),
            named("switch", "arduino.switch", "mode switch", EventLevel.INFO),
            new EventRule("armed", telemetry -> telemetry.flag("armed"), EventRule::armed),
            new EventRule("board", EventRule::board, (before, now) ->
                    part("board", EventLevel.ALARM, before, now)),
            new EventRule("phone", EventRule::phone, (before, now) ->
                    part("phone", EventLevel.WARNING, before, now)),
            new EventRule("panic", BusyState::of, EventRule::panic),
            new EventRule("vetoes", EventRule::vetoes, EventRule::vetoes),
            named("role", "ground.role", "role of this ground", EventLevel.WARNING),
            source("orientation"), source("location"), source("altitude"), source("heading"),
            source("battery"));

    /** The description of a change. */
    static final class Change {
        final String code;
        final EventLevel level;
        final String text;

        Change(String code, EventLevel level, String text) {
            this.code = code;
            this.level = level;
            this.text = text;
        }
    }

    /** Returns the value, or null if unknown, which is not a change. */
    interface Reader {
        Object read(Telemetry telemetry);
    }

    /** Describes a change, null if it needs no event; {@code before} null: the first value. */
    interface Describer {
        Change describe(Object before, Object now);
    }

    final String key;
    final Reader reader;
    final Describer describer;

    private EventRule(String key, Reader reader, Describer describer) {
        this.key = key;
        this.reader = reader;
        this.describer = describer;
    }

    /** Adds the events of the board's status after those of the modes. */
    private static List<EventRule> all(EventRule... others) {
        final List<EventRule> all = new ArrayList<>(Arrays.asList(others));
        int place = AFTER_ARMED;
        for (BoardAlarm each : BoardSchema.ALARMS) {
            if (each.isEvent) {
                // A lambda: a bound method reference needs java.util.Objects, which API 16 lacks.
                all.add(place++, new EventRule(each.path, telemetry -> each.holds(telemetry),
                        (before, now) -> each.describe(before, now)));
            }
        }
        return Collections.unmodifiableList(all);
    }

    /** Returns whether the board is connected, or NOT_YET, or null if unknown. */
    static Object board(Telemetry telemetry) {
        return connected(telemetry, "arduino.connected", "flight", "rx", "servo");
    }

    /** Returns whether the airborne phone is connected, or NOT_YET, or null if unknown. */
    static Object phone(Telemetry telemetry) {
        return connected(telemetry, "android.connected", "battery");
    }

    private static Object connected(Telemetry telemetry, String path, String... readings) {
        final Boolean isThere = telemetry.flag(path);
        if (!Boolean.FALSE.equals(isThere)) {
            return isThere;
        }
        for (String reading : readings) {
            if (telemetry.number("age_ms." + reading) != null) {
                return isThere;
            }
        }
        return NOT_YET;
    }

    /** A text whose change is reported with both values. */
    private static EventRule named(String key, String path, String what, EventLevel level) {
        return new EventRule(key, telemetry -> telemetry.text(path), (before, now) ->
                before == null ? null : new Change(key.startsWith("source") ? "source_changed"
                        : key + "_changed", level, what + " " + now + " (was " + before + ")"));
    }

    private static EventRule source(String reading) {
        return named("source " + reading, "source." + reading, reading + " comes from",
                EventLevel.WARNING);
    }

    /** A part that may connect later than the program, and disconnect. */
    private static Change part(String part, EventLevel level, Object before, Object now) {
        if (Boolean.FALSE.equals(now) || now.equals(NOT_YET) && Boolean.TRUE.equals(before)) {
            return new Change(part + "_lost", level, "the " + part + " is gone");
        }
        if (now.equals(NOT_YET)) {
            return before != null ? null : new Change(part + "_missing", EventLevel.INFO,
                    "the " + part + " is not here yet");
        }
        return before == null ? null : new Change(part + "_connected", EventLevel.INFO,
                "the " + part + " is connected" + (before.equals(NOT_YET) ? "" : " again"));
    }

    private static Change armed(Object before, Object now) {
        if (Boolean.TRUE.equals(now)) {
            return new Change("armed", EventLevel.WARNING,
                    before == null ? "the aircraft is armed" : "armed");
        }
        return before == null ? null : new Change("disarmed", EventLevel.INFO, "disarmed");
    }

    private static Change panic(Object before, Object now) {
        if (now instanceof BusyState) {
            return new Change("panic_started", EventLevel.INFO, now.toString());
        }
        return before == null ? null
                : new Change("panic_ended", EventLevel.INFO, "Raspberry Pi no longer busy");
    }

    /** Returns the sorted arming vetoes after their introduction. */
    private static Object vetoes(Telemetry telemetry) {
        final List<String> vetoes = telemetry.texts("vetoes");
        if (vetoes == null) {
            return null;
        }
        final List<String> sorted = new ArrayList<>(vetoes);
        Collections.sort(sorted);
        final boolean isArmed = Boolean.TRUE.equals(telemetry.flag("armed"));
        sorted.add(0, isArmed ? "against arming again: " : "against arming: ");
        return sorted;
    }

    private static Change vetoes(Object before, Object now) {
        final List<?> vetoes = withoutFirst(now);
        if (before == null ? vetoes.isEmpty() : withoutFirst(before).equals(vetoes)) {
            return null;
        }
        if (vetoes.isEmpty()) {
            return new Change("vetoes_cleared", EventLevel.INFO, "no arming vetoes left");
        }
        final StringBuilder text = new StringBuilder();
        for (Object each : vetoes) {
            text.append(text.length() == 0 ? ((List<?>) now).get(0) : "; ").append(each);
        }
        return new Change("vetoes_changed", EventLevel.INFO, text.toString());
    }

    private static List<?> withoutFirst(Object value) {
        final List<?> all = (List<?>) value;
        return all.subList(1, all.size());
    }
}
