// Generated from schema/{telemetry,events,status,commands}.yml by tools/schema.py; do not edit.

/** Effect and holder of each flight mode. */
export const MODES = {
  "ACRO": {"about": "the sticks move the surfaces", "holder": "the pilot"},
  "RATE": {"about": "the sticks ask for rotation", "holder": "the pilot; the Arduino holds the rates"},
  "FBW": {"about": "the sticks ask for attitude, within limits", "holder": "the pilot; the Arduino holds the attitude"},
  "SETPOINT": {"about": "the Raspberry Pi sets the attitude", "holder": "Raspberry Pi; the Arduino holds the attitude"},
  "RETURN": {"about": "the aircraft flies home and circles there", "holder": ""},
  "OUTPUT": {"about": "the Raspberry Pi sets the servo positions", "holder": "Raspberry Pi"},
  "RTH": {"about": "return home, sent by old firmware; without behaviour", "holder": "Arduino"},
  "AUTO": {"about": "the flight mode that the aircraft's navigation.yml names", "holder": ""},
  "CRUISE": {"about": "the aircraft holds height and course", "holder": ""},
  "LOITER": {"about": "the aircraft circles where it is, at constant height", "holder": ""},
  "MISSION": {"about": "the aircraft flies the mission", "holder": ""},
  "GUIDED": {"about": "the aircraft flies to the target and circles there", "holder": ""},
  "CIRCLE": {"about": "the aircraft circles in a gentle bank, without a position", "holder": ""},
  "GLIDE": {"about": "the aircraft glides, motor off", "holder": ""},
  "LAND": {"about": "the aircraft lands at home or at the target, against the wind", "holder": ""},
  "TAKEOFF": {"about": "the motor starts when the aircraft is thrown with the throttle stick raised", "holder": ""},
};

/** The board's modes in which a mode of the Raspberry Pi flies. */
export const PI_MODES = [
  "SETPOINT",
  "RETURN",
  "OUTPUT",
];

/** Rows of the board panel; `style` applies to the value `when`. */
export const BOARD_ROWS = [
  {"label": "Receiver", "path": "arduino.receiver_valid", "kind": "flag", "unit": "", "yes": "valid", "no": "NOT VALID", "style": "alarm", "when": false},
  {"label": "IMU", "path": "arduino.imu_valid", "kind": "flag", "unit": "", "yes": "valid", "no": "NOT VALID", "style": "alarm", "when": false},
  {"label": "Gyro's bias", "path": "arduino.bias_stored", "kind": "flag", "unit": "", "yes": "an old one", "no": "fresh", "style": "warning", "when": true},
  {"label": "Last reset", "path": "arduino.reset_cause", "kind": "text", "unit": "", "yes": "yes", "no": "no", "style": "", "when": null},
  {"label": "Reset in flight", "path": "arduino.restored", "kind": "flag", "unit": "", "yes": "YES", "no": "no", "style": "warning", "when": true},
  {"label": "Loop", "path": "arduino.loop_us", "kind": "number", "unit": "us", "yes": "yes", "no": "no", "style": "", "when": null},
  {"label": "Late", "path": "arduino.late_us", "kind": "number", "unit": "us", "yes": "yes", "no": "no", "style": "", "when": null},
  {"label": "Frame errors", "path": "arduino.frame_errors", "kind": "number", "unit": "", "yes": "yes", "no": "no", "style": "", "when": null},
  {"label": "Framing", "path": "arduino.framing", "kind": "text", "unit": "", "yes": "yes", "no": "no", "style": "", "when": null},
  {"label": "Processor", "path": "load.cpu", "kind": "number", "unit": "%", "yes": "yes", "no": "no", "style": "", "when": null},
  {"label": "Memory", "path": "load.ram", "kind": "number", "unit": "%", "yes": "yes", "no": "no", "style": "", "when": null},
  {"label": "Up runs for", "path": "system.uptime_s", "kind": "number", "unit": "s", "yes": "yes", "no": "no", "style": "", "when": null},
];

/** Rows of the navigation panel. */
export const NAVIGATION_ROWS = [
  {"label": "Time home", "path": "home.time_s", "unit": "s", "decimals": 0, "optional": false},
  {"label": "Above sea level", "path": "navigation.altitude", "unit": "m", "decimals": 1, "optional": false},
  {"label": "Above home", "path": "navigation.height", "unit": "m", "decimals": 1, "optional": false},
  {"label": "Ground speed", "path": "navigation.speed", "unit": "m/s", "decimals": 1, "optional": false},
  {"label": "Climb", "path": "navigation.climb", "unit": "m/s", "decimals": 1, "optional": false},
  {"label": "Airspeed", "path": "navigation.airspeed", "unit": "m/s", "decimals": 1, "optional": false},
  {"label": "Wind", "path": "navigation.wind.speed", "unit": "m/s", "decimals": 1, "optional": false},
  {"label": "Wind from", "path": "navigation.wind.from", "unit": "deg", "decimals": 0, "optional": false},
  {"label": "Position sd", "path": "navigation.sd.position", "unit": "m", "decimals": 1, "optional": false},
  {"label": "Altitude sd", "path": "navigation.sd.altitude", "unit": "m", "decimals": 1, "optional": false},
  {"label": "Satellites", "path": "location.satellites", "unit": "", "decimals": 0, "optional": true},
  {"label": "Fix accuracy", "path": "location.accuracy", "unit": "m", "decimals": 1, "optional": true},
  {"label": "Mission item", "path": "mission.item", "unit": "", "decimals": 0, "optional": true},
  {"label": "Fence", "path": "fence.margin", "unit": "m", "decimals": 0, "optional": false},
];

/** Why a flight mode is not offered, or was replaced, by code. */
export const MODE_REASONS = {
  "mode_failed": "it failed",
  "mode_overrun": "it took too long",
  "demand_invalid": "it demanded what is not possible",
  "mode_refused": "it cannot be entered now",
  "mode_unknown": "no module provides it",
  "fence": "the fence is near",
  "receiver_lost": "the receiver is lost",
  "uplink_lost": "the uplink is lost",
  "flight_battery_critical": "the flight battery is critically low",
  "flight_battery_low": "the flight battery is low",
  "phone_battery": "the phone's battery is low",
  "no_progress": "the wind is stronger than the aircraft",
  "overload": "the Raspberry Pi is overloaded",
  "no_home": "home is not set",
  "home_too_far": "home is too far away",
  "no_target": "it needs a target: choose a place on the map",
  "target_too_far": "the target is too far away",
  "target_too_high": "the target is too far above the aircraft",
  "target_too_low": "the target is too far below the aircraft",
  "target_below_home": "the target is below home",
  "no_mission": "there is no mission: upload one",
  "mission_invalid": "the mission cannot be flown from this home or in this fence",
  "target_radius": "the radius of the target is not above 0",
  "wind_too_strong": "the wind is too strong for an approach",
  "on_ground": "the aircraft is on the ground",
  "in_flight": "the aircraft moves already",
  "throttle_not_low": "close the throttle stick first",
  "no_motor": "the aircraft has no motor",
  "orientation": "orientation missing or too old",
  "rx": "receiver missing or too old",
  "servo": "servos missing or too old",
  "flight": "flight state missing or too old",
  "location": "location missing or too old",
  "altitude": "altitude missing or too old",
  "heading": "heading missing or too old",
  "battery": "battery missing or too old",
  "navigation": "navigation missing or too old",
};

/** An older frame is shown as stale, before the second is over. */
export const SILENT_S = 0.9;

/** Two clocks run apart by no more than this. */
export const DRIFT = 0.0001;

/** The readings with ages in telemetry; older ones are shown as stale. */
export const READINGS = {
  "orientation": {"title": "", "stale_s": 0.9},
  "rx": {"title": "receiver", "stale_s": 0.9},
  "servo": {"title": "servos", "stale_s": 0.9},
  "flight": {"title": "flight state", "stale_s": 0.9},
  "location": {"title": "", "stale_s": 1.9},
  "altitude": {"title": "", "stale_s": 1.9},
  "heading": {"title": "", "stale_s": 1.9},
  "battery": {"title": "", "stale_s": 120.0},
  "navigation": {"title": "", "stale_s": 3.0},
};

/** The reading whose age a field has. */
export const READING_OF = {
  "orientation.roll": "orientation",
  "orientation.pitch": "orientation",
  "orientation.yaw": "orientation",
  "rates.roll": "orientation",
  "rates.pitch": "orientation",
  "rates.yaw": "orientation",
  "rx.ailerons": "rx",
  "rx.elevator": "rx",
  "rx.throttle": "rx",
  "rx.rudder": "rx",
  "rx.aux1": "rx",
  "rx.aux2": "rx",
  "servo.ailerons": "servo",
  "servo.elevator": "servo",
  "servo.throttle": "servo",
  "servo.rudder": "servo",
  "location.latitude": "location",
  "location.longitude": "location",
  "location.altitude": "location",
  "home.distance": "location",
  "home.bearing": "location",
  "home.time_s": "navigation",
  "navigation.latitude": "navigation",
  "navigation.longitude": "navigation",
  "navigation.altitude": "navigation",
  "navigation.height": "navigation",
  "navigation.speed": "navigation",
  "navigation.climb": "navigation",
  "navigation.airspeed": "navigation",
  "navigation.course": "navigation",
  "navigation.heading": "navigation",
  "navigation.wind.speed": "navigation",
  "navigation.wind.from": "navigation",
  "navigation.sd.position": "navigation",
  "navigation.sd.altitude": "navigation",
  "navigation.sd.wind": "navigation",
  "navigation.sd.airspeed": "navigation",
  "navigation.sd.heading": "navigation",
  "location.satellites": "location",
  "location.accuracy": "location",
  "location.fix": "location",
  "location.pdop": "location",
  "navigation.motor_stopped": "navigation",
  "mission.distance": "navigation",
  "altitude": "altitude",
  "heading.actual": "heading",
  "heading.required": "heading",
  "flight_mode": "flight",
  "fence.margin": "navigation",
  "armed": "flight",
  "in_flight": "flight",
  "arduino.switch": "flight",
  "arduino.receiver_valid": "flight",
  "arduino.imu_valid": "flight",
  "arduino.failsafe": "flight",
  "arduino.bias_stored": "flight",
  "arduino.pi_received": "flight",
  "arduino.reset_cause": "flight",
  "arduino.restored": "flight",
  "arduino.loop_us": "flight",
  "arduino.late_us": "flight",
  "arduino.frame_errors": "flight",
  "arduino.flight_battery_v": "flight",
  "arduino.flight_battery_a": "flight",
  "arduino.flight_battery_low": "flight",
  "arduino.flight_battery_critical": "flight",
  "android.batteryLevel": "battery",
};

/** Limits of the alarms of numbers. */
export const LIMITS = {
  "battery_low": 20,
  "battery_empty": 10,
};

/** The outcomes of sent Commands. */
export const OUTCOMES = {
  "ack": "carried out",
  "nack": "refused",
  "timeout": "outcome unknown",
  "unsent": "not sent",
  "refused": "refused by the ground station",
};
