package org.raspilot.up.ground;

/** One line of the list of all telemetry. Immutable. */
public final class TelemetryRow {
    private final String path;
    private final String value;
    private final String unit;

    TelemetryRow(String path, String value, String unit) {
        this.path = path;
        this.value = value;
        this.unit = unit;
    }

    /** Returns the keys joined by dots, safe to show. */
    public String path() {
        return path;
    }

    /** Returns the value as text, safe to display; {@code --} if unknown. */
    public String value() {
        return value;
    }

    /** Returns the unit, empty if absent or unknown. */
    public String unit() {
        return unit;
    }

    @Override
    public String toString() {
        return unit.isEmpty() ? path + " " + value : path + " " + value + " " + unit;
    }
}
