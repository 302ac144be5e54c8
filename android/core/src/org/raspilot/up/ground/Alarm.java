package org.raspilot.up.ground;

/** Something that is wrong now. Immutable. */
public final class Alarm {
    /** A fault; at most one alarm of each kind. */
    public enum Kind {
        /** No current telemetry: the link, the aircraft or its sender is silent. */
        SILENT,
        // schema begin
        /** The receiver is lost. */
        RECEIVER,
        /** The IMU is invalid: no stabilisation. */
        IMU,
        /** Failsafe: the Arduino flies without a receiver. */
        FAILSAFE,
        // schema end
        /** The board is gone. */
        BOARD,
        /** The airborne phone is gone. */
        PHONE,
        /** The airborne phone's battery is low. */
        BATTERY
    }

    public final Kind kind;
    public final EventLevel level;
    /** A description of the fault, safe to display. */
    public final String text;

    Alarm(Kind kind, EventLevel level, String text) {
        this.kind = kind;
        this.level = level;
        this.text = text;
    }

    /** Returns whether the phone should sound and vibrate. */
    public boolean isLoud() {
        return level == EventLevel.ALARM || kind == Kind.BATTERY;
    }

    @Override
    public boolean equals(Object other) {
        if (!(other instanceof Alarm)) {
            return false;
        }
        final Alarm alarm = (Alarm) other;
        return kind == alarm.kind && level == alarm.level && text.equals(alarm.text);
    }

    @Override
    public int hashCode() {
        return (kind.hashCode() * 31 + level.hashCode()) * 31 + text.hashCode();
    }

    @Override
    public String toString() {
        return level + " " + text;
    }
}
