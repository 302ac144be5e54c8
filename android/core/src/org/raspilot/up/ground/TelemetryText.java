package org.raspilot.up.ground;

import java.math.BigDecimal;
import java.math.RoundingMode;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import org.raspilot.up.wire.SafeText;

/** Returns a whole frame as rows for a list, including fields of unknown cogs. */
public final class TelemetryText {
    /** Maximum number of rows; no aircraft sends more. */
    public static final int MAX_ROWS = 500;

    private static final String UNKNOWN = "--";
    private static final int MAX_PATH_LENGTH = 80;
    private static final int MAX_VALUE_LENGTH = 120;
    private static final int MAX_LISTED = 16;

    private TelemetryText() {
    }

    /** Returns the rows in the frame's order, unmodifiable. */
    public static List<TelemetryRow> rows(Telemetry telemetry) {
        final List<TelemetryRow> rows = new ArrayList<>();
        add(rows, "", telemetry.tree);
        return Collections.unmodifiableList(rows);
    }

    /** Returns a number with its unit, such as {@code 12.3 m/s}; null: unknown. */
    public static String value(Telemetry telemetry, String path) {
        final Double number = telemetry.number(path);
        final String unit = TelemetrySchema.UNITS.get(path);
        return number == null ? null : text(path, number) + (unit == null ? "" : " " + unit);
    }

    /** Returns the load and the period of telemetry while the Raspberry Pi is busy. */
    public static String busy(Telemetry telemetry) {
        for (TelemetryRule each : TelemetrySchema.RULES) {
            if (each.code.equals("panic")) {
                return each.filled(telemetry, null, null);
            }
        }
        return "";
    }

    private static void add(List<TelemetryRow> rows, String path, Object value) {
        if (rows.size() >= MAX_ROWS) {
            return;
        }
        if (value instanceof Map && !((Map<?, ?>) value).isEmpty()) {
            for (Map.Entry<?, ?> each : ((Map<?, ?>) value).entrySet()) {
                final String key = each.getKey().toString();
                add(rows, path.isEmpty() ? key : path + "." + key, each.getValue());
            }
        } else if (!path.isEmpty()) {
            final String unit = value instanceof Number && TelemetrySchema.UNITS.containsKey(path)
                    ? TelemetrySchema.UNITS.get(path) : "";
            rows.add(new TelemetryRow(SafeText.of(path, MAX_PATH_LENGTH),
                    SafeText.of(text(path, value), MAX_VALUE_LENGTH), unit));
        }
    }

    private static String text(String path, Object value) {
        if (value == null) {
            return UNKNOWN;
        }
        if (value instanceof Boolean) {
            return Boolean.TRUE.equals(value) ? "yes" : "no";
        }
        if (value instanceof Number) {
            return number((Number) value, TelemetrySchema.DECIMALS.containsKey(path)
                    ? TelemetrySchema.DECIMALS.get(path) : 3);
        }
        if (value instanceof List) {
            return list((List<?>) value);
        }
        return value instanceof Map ? "none" : value.toString();
    }

    private static String list(List<?> values) {
        if (values.isEmpty()) {
            return "none";
        }
        final StringBuilder text = new StringBuilder();
        int count = 0;
        for (Object each : values) {
            if (count == MAX_LISTED) {
                return text.append(", and ").append(values.size() - count).append(" more")
                        .toString();
            }
            text.append(count == 0 ? "" : ", ");
            final boolean isNested = each instanceof Map || each instanceof List;
            text.append(isNested ? "{...}" : text("", each));
            count++;
        }
        return text.toString();
    }

    private static String number(Number value, int decimals) {
        if (!(value instanceof Double)) {
            return value.toString();
        }
        final double exact = value.doubleValue();
        if (exact == 0) {
            return "0";
        }
        if (!(Math.abs(exact) >= 1e-3 && Math.abs(exact) < 1e9)) {
            return value.toString();
        }
        final BigDecimal rounded =
                new BigDecimal(exact).setScale(decimals, RoundingMode.HALF_EVEN);
        return rounded.stripTrailingZeros().toPlainString();
    }

    /** One line of the list of all telemetry. Immutable. */
    public static final class TelemetryRow {
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
}
