package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import org.raspilot.up.wire.SafeText;

/** The flight modes of telemetry: which one acts, which ones are offered, and why others are not. */
public final class FlightModes {
    public static final String RETURN = "RETURN";
    public static final String LOITER = "LOITER";
    public static final String GUIDED = "GUIDED";

    private static final String MISSION = "MISSION";
    private static final String AUTO = "AUTO";
    private static final String UNKNOWN = "mode_unknown";
    /** What a ground may select of an aircraft that does not report it. */
    private static final List<String> BOARD_MODES = Arrays.asList("RATE", "FBW");
    private static final int MAX_MODES = 32;
    private static final int MAX_NAME = 24;

    private FlightModes() {
    }

    /** Returns the mode that acts: the Raspberry Pi's while it flies; null: unknown. */
    public static String acting(Telemetry telemetry) {
        final String board = telemetry.text("flight_mode");
        final String own = telemetry.text("flight_control.mode");
        return TelemetrySchema.PI_MODES.contains(board) && own != null ? own : board;
    }

    /** Returns the mode that acts, in MISSION with its item as in {@code MISSION 3/12}; null: unknown. */
    public static String actingWithProgress(Telemetry telemetry) {
        final String acting = acting(telemetry);
        final Double count = telemetry.number("mission.count");
        final Double item = telemetry.number("mission.item");
        if (!MISSION.equals(acting) || count == null || item == null) {
            return acting;
        }
        final boolean isFinished = Boolean.TRUE.equals(telemetry.flag("mission.is_finished"));
        return acting + (isFinished ? " finished"
                : " " + Math.round(item) + "/" + Math.round(count));
    }

    /**
     * Returns every mode that a ground may select, RETURN and LOITER first, each with the code of
     * the reason why it is not offered now; null: it is.
     */
    public static Map<String, String> all(Telemetry telemetry) {
        final Map<String, String> modes = new LinkedHashMap<>();
        modes.put(RETURN, UNKNOWN);
        modes.put(LOITER, UNKNOWN);
        final Map<String, Object> told = telemetry.object("flight_control.modes");
        final Map<String, Object> own = told != null ? told
                : Collections.<String, Object>singletonMap(AUTO, null);
        for (Map.Entry<String, Object> each : own.entrySet()) {
            if (modes.size() < MAX_MODES) {
                final Object code = each.getValue();
                modes.put(SafeText.of(each.getKey(), MAX_NAME),
                        code == null ? null : SafeText.of(code.toString(), MAX_NAME));
            }
        }
        for (String each : ofBoard(telemetry)) {
            modes.put(each, null);
        }
        return modes;
    }

    /** Returns why a mode is not offered, in words; an unknown code as it is. */
    public static String reason(String code) {
        final String words = TelemetrySchema.MODE_REASONS.get(code);
        return words == null ? code : words;
    }

    /** Returns the mode that replaces the selected one, and why; null: none. */
    public static String fallback(Telemetry telemetry) {
        final String code = telemetry.text("flight_control.fallback");
        return code == null ? null : telemetry.text("flight_control.mode") + " replaces "
                + telemetry.text("flight_control.selected") + ": " + reason(code);
    }

    /** Returns why a failsafe has selected the present mode, in words; null: none has. */
    public static String failsafe(Telemetry telemetry) {
        final String code = telemetry.text("failsafe.cause");
        return code == null ? null : telemetry.text("flight_control.selected") + ": "
                + reason(code);
    }

    private static List<String> ofBoard(Telemetry telemetry) {
        final List<String> told = telemetry.texts("flight_control.board_modes");
        final List<String> modes = new ArrayList<>();
        for (String each : told == null ? BOARD_MODES : told) {
            modes.add(SafeText.of(each, MAX_NAME));
        }
        return modes;
    }
}
