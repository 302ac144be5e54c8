// Generated from schema/{telemetry,events,status}.yml by tools/schema.py; do not edit.

/** Effect and holder of each flight mode. */
export const MODES = {
  "ACRO": {
    "about": "the sticks move the surfaces",
    "holder": "the pilot"
  },
  "RATE": {
    "about": "the sticks ask for rotation",
    "holder": "the pilot; the Arduino holds the rates"
  },
  "FBW": {
    "about": "the sticks ask for attitude, within limits",
    "holder": "Arduino"
  },
  "SETPOINT": {
    "about": "the Raspberry Pi sets the attitude",
    "holder": "Arduino"
  },
  "RETURN": {
    "about": "the Raspberry Pi sets the attitude in receiver failsafe",
    "holder": "Arduino"
  },
  "OUTPUT": {
    "about": "the Raspberry Pi sets the servo positions",
    "holder": "Raspberry Pi"
  },
  "RTH": {
    "about": "return home, sent by old firmware; without behaviour",
    "holder": "Arduino"
  },
  "AUTO": {
    "about": "modules on the Raspberry Pi may fly; without one the sticks ask for attitude",
    "holder": ""
  }
};

/** Rows of the board panel; `style` applies to the value `when`. */
export const BOARD_ROWS = [
  {
    "label": "Receiver",
    "path": "arduino.receiver_valid",
    "kind": "flag",
    "unit": "",
    "yes": "valid",
    "no": "NOT VALID",
    "style": "alarm",
    "when": false
  },
  {
    "label": "IMU",
    "path": "arduino.imu_valid",
    "kind": "flag",
    "unit": "",
    "yes": "valid",
    "no": "NOT VALID",
    "style": "alarm",
    "when": false
  },
  {
    "label": "Gyro's bias",
    "path": "arduino.bias_stored",
    "kind": "flag",
    "unit": "",
    "yes": "an old one",
    "no": "fresh",
    "style": "warning",
    "when": true
  },
  {
    "label": "Last reset",
    "path": "arduino.reset_cause",
    "kind": "text",
    "unit": "",
    "yes": "yes",
    "no": "no",
    "style": "",
    "when": null
  },
  {
    "label": "Reset in flight",
    "path": "arduino.restored",
    "kind": "flag",
    "unit": "",
    "yes": "YES",
    "no": "no",
    "style": "warning",
    "when": true
  },
  {
    "label": "Loop",
    "path": "arduino.loop_us",
    "kind": "number",
    "unit": "us",
    "yes": "yes",
    "no": "no",
    "style": "",
    "when": null
  },
  {
    "label": "Late",
    "path": "arduino.late_us",
    "kind": "number",
    "unit": "us",
    "yes": "yes",
    "no": "no",
    "style": "",
    "when": null
  },
  {
    "label": "Frame errors",
    "path": "arduino.frame_errors",
    "kind": "number",
    "unit": "",
    "yes": "yes",
    "no": "no",
    "style": "",
    "when": null
  },
  {
    "label": "Framing",
    "path": "arduino.framing",
    "kind": "text",
    "unit": "",
    "yes": "yes",
    "no": "no",
    "style": "",
    "when": null
  },
  {
    "label": "Processor",
    "path": "load.cpu",
    "kind": "number",
    "unit": "%",
    "yes": "yes",
    "no": "no",
    "style": "",
    "when": null
  },
  {
    "label": "Memory",
    "path": "load.ram",
    "kind": "number",
    "unit": "%",
    "yes": "yes",
    "no": "no",
    "style": "",
    "when": null
  },
  {
    "label": "Up runs for",
    "path": "system.uptime_s",
    "kind": "number",
    "unit": "s",
    "yes": "yes",
    "no": "no",
    "style": "",
    "when": null
  }
];

/** An older frame is shown as stale, before the second is over. */
export const SILENT_S = 0.9;

/** Two clocks run apart by no more than this. */
export const DRIFT = 0.0001;

/** The readings with ages in telemetry; older ones are shown as stale. */
export const READINGS = {
  "orientation": {
    "title": "",
    "stale_s": 0.9
  },
  "rx": {
    "title": "receiver",
    "stale_s": 0.9
  },
  "servo": {
    "title": "servos",
    "stale_s": 0.9
  },
  "flight": {
    "title": "flight state",
    "stale_s": 0.9
  },
  "location": {
    "title": "",
    "stale_s": 1.9
  },
  "altitude": {
    "title": "",
    "stale_s": 1.9
  },
  "heading": {
    "title": "",
    "stale_s": 1.9
  },
  "battery": {
    "title": "",
    "stale_s": 120.0
  }
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
  "altitude": "altitude",
  "heading.actual": "heading",
  "heading.required": "heading",
  "flight_mode": "flight",
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
  "android.batteryLevel": "battery"
};

/** Limits of the alarms of numbers. */
export const LIMITS = {
  "battery_low": 20,
  "battery_empty": 10
};
