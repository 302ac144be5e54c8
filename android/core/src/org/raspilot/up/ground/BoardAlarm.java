package org.raspilot.up.ground;

/** An event or alarm of the board: a condition of one value of its status. */
final class BoardAlarm extends Fact {
    /** The kind of the alarm; null if it is only an event. */
    final Alarm.Kind alarmKind;
    /** Its text. */
    final String text;
    /** The alarm ends this time after its condition, ms. */
    final long holdMs;

    private final String path;
    private final Boolean when;
    private final double above;
    private final String unless;
    private final EventLevel level;
    private final EventLevel levelArmed;
    private final String end;

    BoardAlarm(String key, String event, Alarm.Kind alarmKind, String path, Boolean when,
            double above, String unless, EventLevel level, EventLevel levelArmed, String text,
            String end, long holdMs) {
        super(key, event);
        this.alarmKind = alarmKind;
        this.path = path;
        this.when = when;
        this.above = above;
        this.unless = unless;
        this.level = level;
        this.levelArmed = levelArmed;
        this.text = text;
        this.end = end;
        this.holdMs = holdMs;
    }

    /** Returns the alarm; null if its condition does not hold. */
    Alarm alarm(Telemetry telemetry) {
        if (alarmKind == null || !Boolean.TRUE.equals(read(telemetry))
                || Boolean.TRUE.equals(telemetry.flag(unless))) {
            return null;
        }
        final boolean isArmed = Boolean.TRUE.equals(telemetry.flag("armed"));
        return new Alarm(alarmKind, isArmed ? levelArmed : level, text);
    }

    @Override
    Object read(Telemetry telemetry) {
        if (when != null) {
            final Boolean flag = telemetry.flag(path);
            return flag == null ? null : (Object) flag.equals(when);
        }
        final Double number = telemetry.number(path);
        return number == null ? null : (Object) (number > above);
    }

    @Override
    String words(Object before, Object now) {
        if (Boolean.TRUE.equals(now)) {
            return text;
        }
        return before == null || end.isEmpty() ? null : end;
    }

    @Override
    EventLevel level(Object before, Object now) {
        return Boolean.TRUE.equals(now) ? level : EventLevel.INFO;
    }
}
