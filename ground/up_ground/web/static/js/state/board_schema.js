// Generated from schema/status.yml by tools/schema.py; do not edit.

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
  }
];
