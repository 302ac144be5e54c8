package org.raspilot.up.ground;

/** Something that is wrong now; at most one alarm of each kind. Immutable. */
public final class Alarm {
    /** {@code silent receiver board battery ...}, as in schema/. */
    public final String kind;
    public final EventLevel level;
    /** The cause, as a stable word. */
    public final String code;
    /** A description of the fault, safe to display. */
    public final String text;

    Alarm(String kind, EventLevel level, String code, String text) {
        this.kind = kind;
        this.level = level;
        this.code = code;
        this.text = text;
    }

    /** Returns whether the phone should sound and vibrate. */
    public boolean isLoud() {
        return level == EventLevel.ALARM || kind.equals("battery");
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof Alarm && toString().equals(other.toString());
    }

    @Override
    public int hashCode() {
        return toString().hashCode();
    }

    @Override
    public String toString() {
        return level + " " + kind + " " + code;
    }
}
