package org.raspilot.up.ground;

/** A value of telemetry whose changes are events, and their texts. */
abstract class EventRule {
    /** Not connected and without a reading so far, which is not a loss. */
    static final String NOT_YET = "not yet";

    final String key;
    final String kind;

    EventRule(String key, String kind) {
        this.key = key;
        this.kind = kind;
    }

    /** Returns the value, or null if unknown, which is not a change. */
    abstract Object read(Telemetry telemetry);

    /** Returns the text of a change, null if it needs none; {@code before} null: the first. */
    abstract String words(Object before, Object now);

    /** Returns how much the change matters. */
    abstract EventLevel level(Object before, Object now);

    /** Returns whether the board is connected, or NOT_YET, or null if unknown. */
    static Object board(Telemetry telemetry) {
        return part(telemetry, "arduino.connected", "flight", "rx", "servo");
    }

    /** Returns whether the airborne phone is connected, or NOT_YET, or null if unknown. */
    static Object phone(Telemetry telemetry) {
        return part(telemetry, "android.connected", "battery");
    }

    private static Object part(Telemetry telemetry, String path, String... readings) {
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
}
