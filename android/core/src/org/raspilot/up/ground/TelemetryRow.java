package org.raspilot.up.ground;

/** One line of the list of all telemetry. Immutable. */
public final class TelemetryRow {
    /** The keys joined by dots, safe to show. */
    public final String path;
    /** The value as text, safe to display; {@code --} if unknown. */
    public final String value;
    /** The unit, empty if absent or unknown. */
    public final String unit;

    TelemetryRow(String path, String value, String unit) {
        this.path = path;
        this.value = value;
        this.unit = unit;
    }

    @Override
    public String toString() {
        return unit.isEmpty() ? path + " " + value : path + " " + value + " " + unit;
    }
}
