package org.raspilot.up.ground;

import java.util.ArrayList;
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
        HOLDS_MS.put("silent", 2000L);
        HOLDS_MS.put("receiver", 2000L);
        HOLDS_MS.put("imu", 2000L);
        HOLDS_MS.put("failsafe", 2000L);
        HOLDS_MS.put("board", 2000L);
        HOLDS_MS.put("phone", 2000L);
        HOLDS_MS.put("battery", 2000L);
        READING_OF.put("orientation.roll", "orientation");
        READING_OF.put("orientation.pitch", "orientation");
        READING_OF.put("orientation.yaw", "orientation");
        READING_OF.put("rates.roll", "orientation");
        READING_OF.put("rates.pitch", "orientation");
        READING_OF.put("rates.yaw", "orientation");
        READING_OF.put("rx.ailerons", "rx");
        READING_OF.put("rx.elevator", "rx");
        READING_OF.put("rx.throttle", "rx");
        READING_OF.put("rx.rudder", "rx");
        READING_OF.put("rx.aux1", "rx");
        READING_OF.put("rx.aux2", "rx");
        READING_OF.put("servo.ailerons", "servo");
        READING_OF.put("servo.elevator", "servo");
        READING_OF.put("servo.throttle", "servo");
        READING_OF.put("servo.rudder", "servo");
        READING_OF.put("location.latitude", "location");
        READING_OF.put("location.longitude", "location");
        READING_OF.put("location.altitude", "location");
        READING_OF.put("home.distance", "location");
        READING_OF.put("home.bearing", "location");
        READING_OF.put("altitude", "altitude");
        READING_OF.put("heading.actual", "heading");
        READING_OF.put("heading.required", "heading");
        READING_OF.put("flight_mode", "flight");
        READING_OF.put("armed", "flight");
        READING_OF.put("in_flight", "flight");
        READING_OF.put("arduino.switch", "flight");
        READING_OF.put("arduino.receiver_valid", "flight");
        READING_OF.put("arduino.imu_valid", "flight");
        READING_OF.put("arduino.failsafe", "flight");
        READING_OF.put("arduino.bias_stored", "flight");
        READING_OF.put("arduino.reset_cause", "flight");
        READING_OF.put("arduino.restored", "flight");
        READING_OF.put("arduino.loop_us", "flight");
        READING_OF.put("arduino.late_us", "flight");
        READING_OF.put("arduino.frame_errors", "flight");
        READING_OF.put("android.batteryLevel", "battery");
        UNITS.put("orientation.roll", "deg");
        UNITS.put("orientation.pitch", "deg");
        UNITS.put("orientation.yaw", "deg");
        UNITS.put("rates.roll", "deg/s");
        UNITS.put("rates.pitch", "deg/s");
        UNITS.put("rates.yaw", "deg/s");
        UNITS.put("rx.ailerons", "us");
        UNITS.put("rx.elevator", "us");
        UNITS.put("rx.throttle", "us");
        UNITS.put("rx.rudder", "us");
        UNITS.put("rx.aux1", "us");
        UNITS.put("rx.aux2", "us");
        UNITS.put("servo.ailerons", "us");
        UNITS.put("servo.elevator", "us");
        UNITS.put("servo.throttle", "us");
        UNITS.put("servo.rudder", "us");
        UNITS.put("location.latitude", "deg");
        UNITS.put("location.longitude", "deg");
        UNITS.put("location.altitude", "m");
        UNITS.put("home.distance", "m");
        UNITS.put("home.bearing", "deg");
        UNITS.put("altitude", "m");
        UNITS.put("altitude_required", "m");
        UNITS.put("heading.actual", "deg");
        UNITS.put("heading.required", "deg");
        UNITS.put("arduino.loop_us", "us");
        UNITS.put("arduino.late_us", "us");
        UNITS.put("android.batteryLevel", "%");
        UNITS.put("load.cpu", "%");
        UNITS.put("load.ram", "%");
        UNITS.put("load.delay_ms", "ms");
        UNITS.put("black_box.megabytes", "MB");
        UNITS.put("system.uptime_s", "s");
        UNITS.put("system.period_ms", "ms");
        UNITS.put("system.clock_ms", "ms");
        UNITS.put("age_ms.orientation", "ms");
        UNITS.put("age_ms.rx", "ms");
        UNITS.put("age_ms.servo", "ms");
        UNITS.put("age_ms.flight", "ms");
        UNITS.put("age_ms.location", "ms");
        UNITS.put("age_ms.altitude", "ms");
        UNITS.put("age_ms.heading", "ms");
        UNITS.put("age_ms.battery", "ms");
        DECIMALS.put("location.latitude", 6);
        DECIMALS.put("location.longitude", 6);
        LIMITS.put("battery_low", 20.0);
        LIMITS.put("battery_empty", 10.0);
        RULES.add(new TelemetryRule(
                "event", "mode",
                "code", "flight_mode",
                "level", "info",
                "text", "flight mode {value} (was {before})",
                "path", "flight_mode",
                "type", "text"));
        RULES.add(new TelemetryRule(
                "event", "mode",
                "code", "mode",
                "level", "info",
                "text", "mode {value} (was {before})",
                "path", "mode",
                "type", "text"));
        RULES.add(new TelemetryRule(
                "path", "armed",
                "type", "flag",
                "event", "armed",
                "code", "armed",
                "level", "warning",
                "text", "the aircraft is armed",
                "end", "the aircraft is disarmed",
                "end_code", "disarmed",
                "level_armed", "warning",
                "when", "true"));
        RULES.add(new TelemetryRule(
                "event", "mode",
                "code", "switch",
                "level", "info",
                "text", "switch position {value} (was {before})",
                "path", "arduino.switch",
                "type", "text"));
        RULES.add(new TelemetryRule(
                "path", "arduino.receiver_valid",
                "type", "flag",
                "event", "failsafe",
                "code", "receiver_lost",
                "level", "warning",
                "text", "the receiver is lost",
                "end", "the receiver is back",
                "end_code", "receiver_back",
                "alarm", "receiver",
                "level_armed", "alarm",
                "unless", "arduino.failsafe",
                "when", "false"));
        RULES.add(new TelemetryRule(
                "path", "arduino.imu_valid",
                "type", "flag",
                "event", "source",
                "code", "imu_invalid",
                "level", "alarm",
                "text", "the IMU is invalid: no stabilisation",
                "end", "the IMU is valid",
                "end_code", "imu_valid",
                "alarm", "imu",
                "level_armed", "alarm",
                "when", "false"));
        RULES.add(new TelemetryRule(
                "path", "arduino.failsafe",
                "type", "flag",
                "event", "failsafe",
                "code", "failsafe",
                "level", "alarm",
                "text", "failsafe: the Arduino flies without a receiver",
                "end", "the failsafe is over",
                "end_code", "failsafe_over",
                "alarm", "failsafe",
                "level_armed", "alarm",
                "when", "true"));
        RULES.add(new TelemetryRule(
                "path", "arduino.restored",
                "type", "flag",
                "event", "source",
                "code", "board_reset",
                "level", "alarm",
                "text", "the Arduino was reset in flight and restored its state",
                "level_armed", "alarm",
                "when", "true"));
        RULES.add(new TelemetryRule(
                "path", "arduino.connected",
                "type", "flag",
                "event", "link",
                "code", "board_lost",
                "level", "alarm",
                "text", "the Arduino is disconnected",
                "end", "the Arduino is connected",
                "end_code", "board_connected",
                "alarm", "board",
                "level_armed", "alarm",
                "when", "false",
                "awaits", "flight,rx,servo",
                "awaited_code", "board_awaited",
                "awaited_text", "the Arduino is not connected yet",
                "awaited_level", "warning"));
        RULES.add(new TelemetryRule(
                "path", "android.connected",
                "type", "flag",
                "event", "link",
                "code", "phone_lost",
                "level", "warning",
                "text", "the phone is disconnected",
                "end", "the phone is connected",
                "end_code", "phone_connected",
                "alarm", "phone",
                "level_armed", "warning",
                "when", "false",
                "awaits", "battery",
                "awaited_code", "phone_awaited",
                "awaited_text", "the phone is not connected yet"));
        RULES.add(new TelemetryRule(
                "event", "source",
                "code", "phone_refused",
                "level", "warning",
                "text", "another phone, {value}, is refused: one is connected",
                "first", "true",
                "path", "android.competitor",
                "type", "text"));
        RULES.add(new TelemetryRule(
                "path", "android.batteryLevel",
                "type", "number",
                "event", "battery",
                "code", "battery_low",
                "level", "warning",
                "text", "the phone's battery is low",
                "end", "the phone's battery is charged",
                "end_code", "battery_charged",
                "alarm", "battery",
                "level_armed", "warning",
                "below", "20",
                "back", "3"));
        RULES.add(new TelemetryRule(
                "path", "android.batteryLevel",
                "type", "number",
                "code", "battery_empty",
                "level", "alarm",
                "text", "the phone's battery is nearly empty",
                "alarm", "battery",
                "level_armed", "alarm",
                "below", "10"));
        RULES.add(new TelemetryRule(
                "path", "load.panic",
                "type", "flag",
                "event", "panic",
                "code", "panic",
                "level", "info",
                "text", "Raspberry Pi busy ({load.cpu} %): telemetry every {system.period_ms or load.delay_ms} ms",
                "end", "Raspberry Pi no longer busy",
                "end_code", "panic_over",
                "level_armed", "info",
                "when", "true"));
        RULES.add(new TelemetryRule(
                "event", "veto",
                "code", "vetoes",
                "level", "info",
                "text", "vetoes against arming: {value}",
                "end_code", "vetoes_cleared",
                "end", "no veto against arming",
                "path", "vetoes",
                "type", "texts"));
        RULES.add(new TelemetryRule(
                "event", "link",
                "code", "role",
                "level", "warning",
                "text", "the ground's role is {value} (was {before})",
                "path", "ground.role",
                "type", "text"));
        RULES.add(new TelemetryRule(
                "path", "source.orientation",
                "type", "text",
                "event", "source",
                "level", "warning",
                "code", "source_changed",
                "text", "orientation comes from {value} (was {before})"));
        RULES.add(new TelemetryRule(
                "path", "source.location",
                "type", "text",
                "event", "source",
                "level", "warning",
                "code", "source_changed",
                "text", "location comes from {value} (was {before})"));
        RULES.add(new TelemetryRule(
                "path", "source.altitude",
                "type", "text",
                "event", "source",
                "level", "warning",
                "code", "source_changed",
                "text", "altitude comes from {value} (was {before})"));
        RULES.add(new TelemetryRule(
                "path", "source.heading",
                "type", "text",
                "event", "source",
                "level", "warning",
                "code", "source_changed",
                "text", "heading comes from {value} (was {before})"));
        RULES.add(new TelemetryRule(
                "path", "source.battery",
                "type", "text",
                "event", "source",
                "level", "warning",
                "code", "source_changed",
                "text", "battery comes from {value} (was {before})"));
        EVENTS.put("silent", new TelemetryRule(
                "event", "link",
                "code", "silent",
                "level", "alarm",
                "text", "the aircraft is silent",
                "alarm", "silent"));
        EVENTS.put("late", new TelemetryRule(
                "event", "link",
                "code", "late",
                "level", "alarm",
                "text", "telemetry arrives too late",
                "alarm", "silent"));
        EVENTS.put("heard", new TelemetryRule(
                "event", "link",
                "code", "heard",
                "level", "info",
                "text", "telemetry arrives again"));
        EVENTS.put("no_link", new TelemetryRule(
                "event", "link",
                "code", "no_link",
                "level", "alarm",
                "text", "no link",
                "alarm", "silent"));
        EVENTS.put("link_open", new TelemetryRule(
                "event", "link",
                "code", "link_open",
                "level", "info",
                "text", "the link is open"));
        EVENTS.put("link_lost", new TelemetryRule(
                "event", "link",
                "code", "link_lost",
                "level", "warning",
                "text", "the link is lost"));
        EVENTS.put("aircraft_online", new TelemetryRule(
                "event", "link",
                "code", "aircraft_online",
                "level", "info",
                "text", "the aircraft is connected"));
        EVENTS.put("aircraft_offline", new TelemetryRule(
                "event", "link",
                "code", "aircraft_offline",
                "level", "warning",
                "text", "the aircraft is not connected to the proxy",
                "alarm", "silent"));
        EVENTS.put("gains_invalid", new TelemetryRule(
                "event", "gains",
                "code", "gains_invalid",
                "level", "warning",
                "text", "the aircraft sent an incomplete set of gains"));
        OUTCOMES.put("ack", "carried out");
        OUTCOMES.put("nack", "refused");
        OUTCOMES.put("timeout", "outcome unknown");
        OUTCOMES.put("unsent", "not sent");
        OUTCOMES.put("refused", "refused by the ground station");
    }

    private TelemetrySchema() {
    }
}
