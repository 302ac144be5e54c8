package org.raspilot.up.ground;

/** A condition of one value of the board's status that is an event, an alarm or both. */
final class BoardAlarm {
    /** The kind of the alarm; null if it is only an event. */
    final Alarm.Kind kind;
    final boolean isEvent;
    final String path;
    /** The alarm ends this time after its condition, ms. */
    final long holdMs;

    private final Boolean when;
    private final double above;
    private final String unless;
    private final EventLevel level;
    private final EventLevel levelArmed;
    private final String code;
    private final String text;
    private final String endCode;
    private final String end;

    BoardAlarm(Alarm.Kind kind, boolean isEvent, String path, Boolean when, double above,
            String unless, EventLevel level, EventLevel levelArmed, String code, String text,
            String endCode, String end, long holdMs) {
        this.kind = kind;
        this.isEvent = isEvent;
        this.path = path;
        this.when = when;
        this.above = above;
        this.unless = unless;
        this.level = level;
        this.levelArmed = levelArmed;
        this.code = code;
        this.text = text;
        this.endCode = endCode;
        this.end = end;
        this.holdMs = holdMs;
    }

    /** Returns the alarm; null if its condition does not hold. */
    Alarm alarm(Telemetry telemetry) {
        if (kind == null || !Boolean.TRUE.equals(holds(telemetry))
                || Boolean.TRUE.equals(telemetry.flag(unless))) {
            return null;
        }
        final boolean isArmed = Boolean.TRUE.equals(telemetry.flag("armed"));
        return new Alarm(kind, isArmed ? levelArmed : level, text);
    }

    /** Returns whether the condition holds, null if unknown. */
    Object holds(Telemetry telemetry) {
        if (when != null) {
            final Boolean flag = telemetry.flag(path);
            return flag == null ? null : (Object) flag.equals(when);
        }
        final Double number = telemetry.number(path);
        return number == null ? null : (Object) (number > above);
    }

    /** Describes a change of the condition, null if it needs no event. */
    EventRule.Change describe(Object before, Object now) {
        if (Boolean.TRUE.equals(now)) {
            return new EventRule.Change(code, level, text);
        }
        return before == null || end.isEmpty() ? null
                : new EventRule.Change(endCode, EventLevel.INFO, end);
    }
}
