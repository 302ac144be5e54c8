package org.raspilot.up.ground;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.Collections;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

/** Tables of telemetry.
 *  Generated from schema/{telemetry,events,status,commands}.yml by tools/schema.py; do not edit. */
public final class TelemetrySchema {
    static final long PAUSE_MS = 3000;
    static final long MAX_PAUSE_MS = 30000;
    static final long QUIET_MS = 60000;
    static final long SILENT_MS = 900;
    static final long NEW_CLOCK_MS = 30000;
    static final double DRIFT = 0.0001;
    /** Maximum age of a reading that is not stale, ms. */
    static final Map<String, Long> STALE_MS = new LinkedHashMap<>();
    /** Times for which alarms outlast their conditions, ms, by kind in the order of display. */
    static final Map<String, Long> HOLDS_MS = new LinkedHashMap<>();
    /** The reading whose age a field has. */
    static final Map<String, String> READING_OF = new HashMap<>();
    static final Map<String, String> UNITS = new HashMap<>();
    /** Decimals of fields that have other than 3. */
    static final Map<String, Integer> DECIMALS = new HashMap<>();
    /** Limits of the alarms of numbers. */
    static final Map<String, Double> LIMITS = new HashMap<>();
    /** Why a flight mode is not offered, or was replaced, by code. */
    static final Map<String, String> MODE_REASONS = new HashMap<>();
    private static final Map<String, String> NAVIGATION = new LinkedHashMap<>();
    private static final Map<String, Boolean> OPTIONAL = new HashMap<>();
    /** The board's modes in which a mode of the Raspberry Pi flies. */
    static final List<String> PI_MODES =
            Arrays.asList("SETPOINT", "RETURN", "OUTPUT");
    static final List<TelemetryRule> RULES = new ArrayList<>();
    /** Events without a field, by code. */
    static final Map<String, TelemetryRule> EVENTS = new HashMap<>();
    /** The outcomes of sent Commands. */
    static final Map<String, String> OUTCOMES = new HashMap<>();

    static {
        STALE_MS.put("orientation", 900L);
        STALE_MS.put("rx", 900L);
        STALE_MS.put("servo", 900L);
        STALE_MS.put("flight", 900L);
        STALE_MS.put("location", 1900L);
        STALE_MS.put("altitude", 1900L);
        STALE_MS.put("heading", 1900L);
        STALE_MS.put("battery", 120000L);
        STALE_MS.put("navigation", 3000L);
        HOLDS_MS.put("silent", 2000L);
        HOLDS_MS.put("motor_stopped", 2000L);
        HOLDS_MS.put("receiver", 2000L);
        HOLDS_MS.put("imu", 2000L);
        HOLDS_MS.put("failsafe", 2000L);
        HOLDS_MS.put("board", 2000L);
        HOLDS_MS.put("flight_battery", 2000L);
        HOLDS_MS.put("phone", 2000L);
        HOLDS_MS.put("battery", 2000L);
        put(READING_OF, "orientation", "orientation.roll", "orientation.pitch", "orientation.yaw",
                "rates.roll", "rates.pitch", "rates.yaw");
        put(READING_OF, "rx", "rx.ailerons", "rx.elevator", "rx.throttle", "rx.rudder", "rx.aux1",
                "rx.aux2");
        put(READING_OF, "servo", "servo.ailerons", "servo.elevator", "servo.throttle",
                "servo.rudder");
        put(READING_OF, "location", "location.latitude", "location.longitude", "location.altitude",
                "home.distance", "home.bearing", "location.satellites", "location.accuracy",
                "location.fix", "location.pdop");
        put(READING_OF, "navigation", "home.time_s", "navigation.latitude", "navigation.longitude",
                "navigation.altitude", "navigation.height", "navigation.speed", "navigation.climb",
                "navigation.airspeed", "navigation.course", "navigation.heading",
                "navigation.wind.speed", "navigation.wind.from", "navigation.sd.position",
                "navigation.sd.altitude", "navigation.sd.wind", "navigation.sd.airspeed",
                "navigation.sd.heading", "navigation.motor_stopped", "mission.distance",
                "fence.margin");
        put(READING_OF, "altitude", "altitude");
        put(READING_OF, "heading", "heading.actual", "heading.required");
        put(READING_OF, "flight", "flight_mode", "armed", "in_flight", "arduino.switch",
                "arduino.receiver_valid", "arduino.imu_valid", "arduino.failsafe",
                "arduino.bias_stored", "arduino.reset_cause", "arduino.restored", "arduino.loop_us",
                "arduino.late_us", "arduino.frame_errors", "arduino.flight_battery_v",
                "arduino.flight_battery_a", "arduino.flight_battery_low",
                "arduino.flight_battery_critical");
        put(READING_OF, "battery", "android.batteryLevel");
        put(UNITS, "deg", "orientation.roll", "orientation.pitch", "orientation.yaw",
                "location.latitude", "location.longitude", "home.bearing", "home.latitude",
                "home.longitude", "navigation.latitude", "navigation.longitude",
                "navigation.course", "navigation.heading", "navigation.wind.from",
                "navigation.sd.heading", "navigation.target.latitude",
                "navigation.target.longitude", "heading.actual", "heading.required");
        put(UNITS, "deg/s", "rates.roll", "rates.pitch", "rates.yaw");
        put(UNITS, "us", "rx.ailerons", "rx.elevator", "rx.throttle", "rx.rudder", "rx.aux1",
                "rx.aux2", "servo.ailerons", "servo.elevator", "servo.throttle", "servo.rudder",
                "arduino.loop_us", "arduino.late_us");
        put(UNITS, "m", "location.altitude", "home.distance", "home.altitude",
                "navigation.altitude", "navigation.height", "navigation.sd.position",
                "navigation.sd.altitude", "location.accuracy", "navigation.target.altitude",
                "navigation.target.radius", "mission.distance", "altitude", "altitude_required",
                "fence.margin", "fence.radius", "fence.ceiling", "fence.floor");
        put(UNITS, "s", "home.time_s", "system.uptime_s");
        put(UNITS, "m/s", "navigation.speed", "navigation.climb", "navigation.airspeed",
                "navigation.wind.speed", "navigation.sd.wind", "navigation.sd.airspeed");
        put(UNITS, "V", "arduino.flight_battery_v");
        put(UNITS, "A", "arduino.flight_battery_a");
        put(UNITS, "%", "android.batteryLevel", "load.cpu", "load.ram");
        put(UNITS, "ms", "load.delay_ms", "system.period_ms", "system.clock_ms",
                "age_ms.orientation", "age_ms.rx", "age_ms.servo", "age_ms.flight",
                "age_ms.location", "age_ms.altitude", "age_ms.heading", "age_ms.battery",
                "age_ms.navigation");
        put(UNITS, "MB/h", "uplink.mb_per_hour", "uplink.budget_mb_per_hour");
        put(UNITS, "MB", "uplink.mb", "uplink.mb_in_an_hour", "black_box.megabytes");
        put(DECIMALS, 1, "orientation.roll", "orientation.pitch", "orientation.yaw", "rates.roll",
                "rates.pitch", "rates.yaw", "location.altitude", "home.altitude",
                "navigation.altitude", "navigation.height", "navigation.speed", "navigation.climb",
                "navigation.airspeed", "navigation.wind.speed", "navigation.sd.position",
                "navigation.sd.altitude", "navigation.sd.wind", "navigation.sd.airspeed",
                "navigation.sd.heading", "location.accuracy", "location.pdop",
                "navigation.target.altitude", "navigation.target.radius", "altitude",
                "arduino.flight_battery_a", "uplink.mb_in_an_hour", "black_box.megabytes");
        put(DECIMALS, 6, "location.latitude", "location.longitude", "home.latitude",
                "home.longitude", "navigation.latitude", "navigation.longitude",
                "navigation.target.latitude", "navigation.target.longitude");
        put(DECIMALS, 0, "home.distance", "home.bearing", "home.time_s", "navigation.course",
                "navigation.heading", "navigation.wind.from", "location.satellites",
                "mission.count", "mission.item", "mission.distance", "fence.count",
                "heading.actual", "fence.margin", "fence.radius", "fence.ceiling", "fence.floor",
                "load.cpu", "load.ram", "uplink.grounds", "uplink.left_out");
        put(DECIMALS, 2, "arduino.flight_battery_v", "uplink.mb_per_hour", "uplink.mb",
                "uplink.budget_mb_per_hour");
        LIMITS.put("battery_low", 20.0);
        LIMITS.put("battery_empty", 10.0);
        MODE_REASONS.put("mode_failed", "it failed");
        MODE_REASONS.put("mode_overrun", "it took too long");
        MODE_REASONS.put("demand_invalid", "it demanded what is not possible");
        MODE_REASONS.put("mode_refused", "it cannot be entered now");
        MODE_REASONS.put("mode_unknown", "no module provides it");
        MODE_REASONS.put("fence", "the fence is near");
        MODE_REASONS.put("receiver_lost", "the receiver is lost");
        MODE_REASONS.put("uplink_lost", "the uplink is lost");
        MODE_REASONS.put("flight_battery_critical", "the flight battery is critically low");
        MODE_REASONS.put("flight_battery_low", "the flight battery is low");
        MODE_REASONS.put("phone_battery", "the phone's battery is low");
        MODE_REASONS.put("no_progress", "the wind is stronger than the aircraft");
        MODE_REASONS.put("overload", "the Raspberry Pi is overloaded");
        MODE_REASONS.put("no_home", "home is not set");
        MODE_REASONS.put("home_too_far", "home is too far away");
        MODE_REASONS.put("no_target", "it needs a target: choose a place on the map");
        MODE_REASONS.put("target_too_far", "the target is too far away");
        MODE_REASONS.put("target_too_high", "the target is too far above the aircraft");
        MODE_REASONS.put("target_too_low", "the target is too far below the aircraft");
        MODE_REASONS.put("target_below_home", "the target is below home");
        MODE_REASONS.put("no_mission", "there is no mission: upload one");
        MODE_REASONS.put("mission_invalid", "the mission cannot be flown from this home or in this fence");
        MODE_REASONS.put("target_radius", "the radius of the target is not above 0");
        MODE_REASONS.put("wind_too_strong", "the wind is too strong for an approach");
        MODE_REASONS.put("on_ground", "the aircraft is on the ground");
        MODE_REASONS.put("in_flight", "the aircraft moves already");
        MODE_REASONS.put("throttle_not_low", "close the throttle stick first");
        MODE_REASONS.put("no_motor", "the aircraft has no motor");
        MODE_REASONS.put("orientation", "orientation missing or too old");
        MODE_REASONS.put("rx", "receiver missing or too old");
        MODE_REASONS.put("servo", "servos missing or too old");
        MODE_REASONS.put("flight", "flight state missing or too old");
        MODE_REASONS.put("location", "location missing or too old");
        MODE_REASONS.put("altitude", "altitude missing or too old");
        MODE_REASONS.put("heading", "heading missing or too old");
        MODE_REASONS.put("battery", "battery missing or too old");
        MODE_REASONS.put("navigation", "navigation missing or too old");
        NAVIGATION.put("Time home", "home.time_s");
        NAVIGATION.put("Above sea level", "navigation.altitude");
        NAVIGATION.put("Above home", "navigation.height");
        NAVIGATION.put("Ground speed", "navigation.speed");
        NAVIGATION.put("Climb", "navigation.climb");
        NAVIGATION.put("Airspeed", "navigation.airspeed");
        NAVIGATION.put("Wind", "navigation.wind.speed");
        NAVIGATION.put("Wind from", "navigation.wind.from");
        NAVIGATION.put("Position sd", "navigation.sd.position");
        NAVIGATION.put("Altitude sd", "navigation.sd.altitude");
        NAVIGATION.put("Satellites", "location.satellites");
        NAVIGATION.put("Fix accuracy", "location.accuracy");
        NAVIGATION.put("Mission item", "mission.item");
        NAVIGATION.put("Fence", "fence.margin");
        OPTIONAL.put("location.satellites", true);
        OPTIONAL.put("location.accuracy", true);
        OPTIONAL.put("mission.item", true);
        RULES.add(new TelemetryRule("path", "navigation.motor_stopped", "type", "flag",
                "event", "motor", "code", "motor_stopped", "level", "alarm",
                "text", "the motor gives no thrust", "end", "the motor gives thrust",
                "end_code", "motor_works", "alarm", "motor_stopped", "level_armed", "alarm",
                "when", "true"));
        RULES.add(new TelemetryRule("event", "mode", "code", "flight_mode", "level", "info",
                "text", "flight mode {value} (was {before})", "path", "flight_mode",
                "type", "text"));
        RULES.add(new TelemetryRule("event", "mode", "code", "mode", "level", "info",
                "text", "mode {value} (was {before})", "path", "mode", "type", "text"));
        RULES.add(new TelemetryRule("event", "mode", "code", "fallback", "level", "alarm",
                "text", "{flight_control.mode} replaces {flight_control.selected}: {value}",
                "end_code", "fallback_over", "end", "the selected flight mode acts again",
                "first", "true", "path", "flight_control.fallback", "type", "text"));
        RULES.add(new TelemetryRule("event", "mode", "code", "failsafe", "level", "warning",
                "text", "failsafe: {value}", "end_code", "failsafe_over",
                "end", "no failsafe trigger holds", "path", "failsafe.active", "type", "texts"));
        RULES.add(new TelemetryRule("event", "mode", "code", "failsafe_acts", "level", "alarm",
                "text", "failsafe {value}: {flight_control.mode} flies until the switch leaves AUTO or the ground selects a flight mode",
                "end_code", "failsafe_ended",
                "end", "the pilot or the ground has ended the failsafe", "first", "true",
                "path", "failsafe.cause", "type", "text"));
        RULES.add(new TelemetryRule("path", "armed", "type", "flag", "event", "armed",
                "code", "armed", "level", "warning", "text", "the aircraft is armed",
                "end", "the aircraft is disarmed", "end_code", "disarmed", "level_armed", "warning",
                "when", "true"));
        RULES.add(new TelemetryRule("event", "mode", "code", "switch", "level", "info",
                "text", "switch position {value} (was {before})", "path", "arduino.switch",
                "type", "text"));
        RULES.add(new TelemetryRule("path", "arduino.receiver_valid", "type", "flag",
                "event", "failsafe", "code", "receiver_lost", "level", "warning",
                "text", "the receiver is lost", "end", "the receiver is back",
                "end_code", "receiver_back", "alarm", "receiver", "level_armed", "alarm",
                "unless", "arduino.failsafe", "when", "false"));
        RULES.add(new TelemetryRule("path", "arduino.imu_valid", "type", "flag", "event", "source",
                "code", "imu_invalid", "level", "alarm",
                "text", "the IMU is invalid: no stabilisation", "end", "the IMU is valid",
                "end_code", "imu_valid", "alarm", "imu", "level_armed", "alarm", "when", "false"));
        RULES.add(new TelemetryRule("path", "arduino.failsafe", "type", "flag", "event", "failsafe",
                "code", "failsafe", "level", "alarm",
                "text", "failsafe: the Arduino flies without a receiver",
                "end", "the failsafe is over", "end_code", "failsafe_over", "alarm", "failsafe",
                "level_armed", "alarm", "when", "true"));
        RULES.add(new TelemetryRule("path", "arduino.restored", "type", "flag", "event", "source",
                "code", "board_reset", "level", "alarm",
                "text", "the Arduino was reset in flight and restored its state",
                "level_armed", "alarm", "when", "true"));
        RULES.add(new TelemetryRule("path", "arduino.connected", "type", "flag", "event", "link",
                "code", "board_lost", "level", "alarm", "text", "the Arduino is disconnected",
                "end", "the Arduino is connected", "end_code", "board_connected", "alarm", "board",
                "level_armed", "alarm", "when", "false", "awaits", "flight,rx,servo",
                "awaited_code", "board_awaited", "awaited_text", "the Arduino is not connected yet",
                "awaited_level", "warning"));
        RULES.add(new TelemetryRule("path", "arduino.flight_battery_low", "type", "flag",
                "event", "battery", "code", "flight_battery_low", "level", "warning",
                "text", "the flight battery is low", "end", "the flight battery is no longer low",
                "end_code", "flight_battery_low_over", "alarm", "flight_battery",
                "level_armed", "warning", "when", "true"));
        RULES.add(new TelemetryRule("path", "arduino.flight_battery_critical", "type", "flag",
                "event", "battery", "code", "flight_battery_critical", "level", "alarm",
                "text", "the flight battery is critically low", "alarm", "flight_battery",
                "level_armed", "alarm", "when", "true"));
        RULES.add(new TelemetryRule("path", "android.connected", "type", "flag", "event", "link",
                "code", "phone_lost", "level", "warning", "text", "the phone is disconnected",
                "end", "the phone is connected", "end_code", "phone_connected", "alarm", "phone",
                "level_armed", "warning", "when", "false", "awaits", "battery",
                "awaited_code", "phone_awaited", "awaited_text", "the phone is not connected yet"));
        RULES.add(new TelemetryRule("event", "source", "code", "phone_refused", "level", "warning",
                "text", "another phone, {value}, is refused: one is connected", "first", "true",
                "path", "android.competitor", "type", "text"));
        RULES.add(new TelemetryRule("path", "android.batteryLevel", "type", "number",
                "event", "battery", "code", "battery_low", "level", "warning",
                "text", "the phone's battery is low", "end", "the phone's battery is charged",
                "end_code", "battery_charged", "alarm", "battery", "level_armed", "warning",
                "below", "20", "back", "3"));
        RULES.add(new TelemetryRule("path", "android.batteryLevel", "type", "number",
                "code", "battery_empty", "level", "alarm",
                "text", "the phone's battery is nearly empty", "alarm", "battery",
                "level_armed", "alarm", "below", "10"));
        RULES.add(new TelemetryRule("path", "load.panic", "type", "flag", "event", "panic",
                "code", "panic", "level", "info",
                "text", "Raspberry Pi busy ({load.cpu} %): telemetry every {system.period_ms or load.delay_ms} ms",
                "end", "Raspberry Pi no longer busy", "end_code", "panic_over",
                "level_armed", "info", "when", "true"));
        RULES.add(new TelemetryRule("event", "veto", "code", "vetoes", "level", "info",
                "text", "vetoes against arming: {value}", "end_code", "vetoes_cleared",
                "end", "no veto against arming", "path", "vetoes", "type", "texts"));
        RULES.add(new TelemetryRule("event", "link", "code", "role", "level", "warning",
                "text", "the ground's role is {value} (was {before})", "path", "ground.role",
                "type", "text"));
        RULES.add(new TelemetryRule("event", "link", "code", "uplink_path", "level", "warning",
                "text", "the link to the proxy uses {value} (was {before})", "path", "uplink.path",
                "type", "text"));
        RULES.add(new TelemetryRule("path", "source.orientation", "type", "text", "event", "source",
                "level", "warning", "code", "source_changed",
                "text", "orientation comes from {value} (was {before})"));
        RULES.add(new TelemetryRule("path", "source.location", "type", "text", "event", "source",
                "level", "warning", "code", "source_changed",
                "text", "location comes from {value} (was {before})"));
        RULES.add(new TelemetryRule("path", "source.altitude", "type", "text", "event", "source",
                "level", "warning", "code", "source_changed",
                "text", "altitude comes from {value} (was {before})"));
        RULES.add(new TelemetryRule("path", "source.heading", "type", "text", "event", "source",
                "level", "warning", "code", "source_changed",
                "text", "heading comes from {value} (was {before})"));
        RULES.add(new TelemetryRule("path", "source.battery", "type", "text", "event", "source",
                "level", "warning", "code", "source_changed",
                "text", "battery comes from {value} (was {before})"));
        EVENTS.put("silent", new TelemetryRule("event", "link", "code", "silent", "level", "alarm",
                "text", "the aircraft is silent", "alarm", "silent"));
        EVENTS.put("late", new TelemetryRule("event", "link", "code", "late", "level", "alarm",
                "text", "telemetry arrives too late", "alarm", "silent"));
        EVENTS.put("heard", new TelemetryRule("event", "link", "code", "heard", "level", "info",
                "text", "telemetry arrives again"));
        EVENTS.put("no_link", new TelemetryRule("event", "link", "code", "no_link",
                "level", "alarm", "text", "no link", "alarm", "silent"));
        EVENTS.put("link_open", new TelemetryRule("event", "link", "code", "link_open",
                "level", "info", "text", "the link is open"));
        EVENTS.put("link_lost", new TelemetryRule("event", "link", "code", "link_lost",
                "level", "warning", "text", "the link is lost"));
        EVENTS.put("aircraft_online", new TelemetryRule("event", "link", "code", "aircraft_online",
                "level", "info", "text", "the aircraft is connected"));
        EVENTS.put("aircraft_offline", new TelemetryRule("event", "link",
                "code", "aircraft_offline", "level", "warning",
                "text", "the aircraft is not connected to the proxy", "alarm", "silent"));
        EVENTS.put("gains_invalid", new TelemetryRule("event", "gains", "code", "gains_invalid",
                "level", "warning", "text", "the aircraft sent an incomplete set of gains"));
        OUTCOMES.put("ack", "carried out");
        OUTCOMES.put("nack", "refused");
        OUTCOMES.put("timeout", "outcome unknown");
        OUTCOMES.put("unsent", "not sent");
        OUTCOMES.put("refused", "refused by the ground station");
    }

    /** Paths of the values of navigation, by label in the order of display. */
    public static Map<String, String> navigation() {
        return Collections.unmodifiableMap(NAVIGATION);
    }

    /** Whether a value of navigation is not shown while it is unknown. */
    public static boolean isOptional(String path) {
        return OPTIONAL.containsKey(path);
    }

    private TelemetrySchema() {
    }

    private static <T> void put(Map<String, T> table, T value, String... keys) {
        for (String key : keys) {
            table.put(key, value);
        }
    }
}
