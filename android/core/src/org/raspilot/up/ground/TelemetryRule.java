package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;

/**
 * A field of telemetry whose change is an event, or whose condition is an alarm, as schema/ has it;
 * without a path: an event of the link.
 */
final class TelemetryRule {
    /** The state of a part that was never connected and never reported: it is not lost. */
    static final String AWAITED = "awaited";

    final String path;
    final String code;
    final EventLevel level;
    final String text;
    final boolean isEvent;
    /** Kind of its alarm; empty: none. */
    final String alarmKind;
    private final Map<String, String> columns = new HashMap<>();

    /** Creates a rule of the columns of up/commands/schema_rows.py, a name before each value. */
    TelemetryRule(String... pairs) {
        for (int each = 0; each < pairs.length; each += 2) {
            columns.put(pairs[each], pairs[each + 1]);
        }
        path = of("path");
        code = of("code");
        text = of("text");
        level = levelOf("level");
        isEvent = !of("event").isEmpty();
        alarmKind = of("alarm");
    }

    private String of(String column) {
        final String found = columns.get(column);
        return found == null ? "" : found;
    }

    private EventLevel levelOf(String column) {
        return EventLevel.valueOf(of(column).toUpperCase(Locale.ROOT));
    }

    /** Returns the value or the condition; null (unknown) does not count as a change. */
    Object state(Telemetry telemetry, Object before) {
        final String type = of("type");
        if (type.equals("text")) {
            return telemetry.text(path);
        }
        if (type.equals("texts")) {
            final List<String> texts = telemetry.texts(path);
            if (texts == null) {
                return null;
            }
            final List<String> sorted = new ArrayList<>(texts);
            Collections.sort(sorted);
            return sorted;
        }
        final Object holds = holds(telemetry, Boolean.TRUE.equals(before));
        if (!Boolean.TRUE.equals(holds) || of("awaits").isEmpty()) {
            return holds;
        }
        for (String reading : of("awaits").split(",")) {
            if (telemetry.number("age_ms." + reading) != null) {
                return holds;
            }
        }
        return AWAITED;
    }

    private Object holds(Telemetry telemetry, boolean before) {
        if (of("type").equals("flag")) {
            final Boolean flag = telemetry.flag(path);
            return flag == null ? null : Boolean.valueOf(flag.toString().equals(of("when")));
        }
        final Double number = telemetry.number(path);
        if (number == null) {
            return null;
        }
        final double margin =
                before && !of("back").isEmpty() ? Double.parseDouble(of("back")) : 0;
        return of("above").isEmpty() ? number < Double.parseDouble(of("below")) + margin
                : number > Double.parseDouble(of("above")) - margin;
    }

    /** Adds the event of a change; {@code before} is null for the first value. */
    void report(Object before, Object now, Telemetry telemetry, EventLog events, long nowMs) {
        final boolean isText = !(now instanceof Boolean) && !now.equals(AWAITED);
        final boolean isOver = isText
                ? now.equals(Collections.emptyList()) : Boolean.FALSE.equals(now);
        final boolean isAwaited = now.equals(AWAITED) && !Boolean.FALSE.equals(before);
        if (isOver) {
            final boolean wasOn = before != null && !Boolean.FALSE.equals(before);
            if (wasOn && !of("end").isEmpty()) {
                events.add(nowMs, EventLevel.INFO, of("end_code"), of("end"));
            }
        } else if (isAwaited) {
            if (before == null) {
                events.add(nowMs, EventLevel.INFO, of("awaited_code"), of("awaited_text"));
            }
        } else if (before != null || !(now instanceof String) || now.equals(AWAITED)
                || !of("first").isEmpty()) {
            events.add(nowMs, level, code, filled(telemetry, now, before));
        }
    }

    /** Returns the alarm, or null; {@code wasThere}: the condition was once known not to hold. */
    Alarm alarm(Object state, Telemetry telemetry, boolean wasThere) {
        final boolean isAwaited = AWAITED.equals(state);
        if (of("alarm").isEmpty() || !isAwaited && !Boolean.TRUE.equals(state)
                || isAwaited && of("awaited_level").isEmpty()
                || Boolean.TRUE.equals(telemetry.flag(of("unless")))) {
            return null;
        }
        if (isAwaited && !wasThere) {
            return new Alarm(of("alarm"), levelOf("awaited_level"), of("awaited_code"),
                    of("awaited_text"));
        }
        final boolean isArmed = Boolean.TRUE.equals(telemetry.flag("armed"));
        return new Alarm(of("alarm"), levelOf(isArmed ? "level_armed" : "level"), code, text);
    }

    /** Returns the text with its values: {@code {value}}, {@code {a.field or another}}. */
    String filled(Telemetry telemetry, Object value, Object before) {
        final StringBuilder filled = new StringBuilder();
        final String[] parts = text.split("[{}]", -1);
        for (int each = 0; each < parts.length; each++) {
            final boolean isName = each % 2 != 0;
            filled.append(isName ? valueOf(parts[each], telemetry, value, before) : parts[each]);
        }
        return filled.toString();
    }

    private static String valueOf(String name, Telemetry telemetry, Object value, Object before) {
        if (name.equals("value") || name.equals("before")) {
            return words(name.equals("value") ? value : before);
        }
        for (String path : Arrays.asList(name.split(" or "))) {
            final Double number = telemetry.number(path);
            if (number != null) {
                return String.format(Locale.ROOT, "%.0f", number);
            }
        }
        return "--";
    }

    private static String words(Object value) {
        if (!(value instanceof List)) {
            return String.valueOf(value);
        }
        final StringBuilder all = new StringBuilder();
        for (Object each : (List<?>) value) {
            all.append(all.length() == 0 ? "" : "; ").append(each);
        }
        return all.toString();
    }
}
