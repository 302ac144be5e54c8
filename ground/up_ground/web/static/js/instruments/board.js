import { html } from "../readout.js";
import { flagText, numberText } from "../state/format.js";
import { Row } from "./row.js";

/** The Arduino as it sees itself, and how busy the Raspberry Pi is. */
export function mount(element, store) {
  const list = html("dl", { class: "rows" });
  element.append(list);
  const good = (value) => (value === false ? "alarm" : "");
  const bad = (value) => (value === true ? "warning" : "");
  const us = (value) => `${numberText(value)} us`;
  const percent = (value) => `${numberText(value)} %`;
  const valid = (value) => flagText(value, "valid", "NOT VALID");
  const rows = [
    new Row(list, "Receiver", "arduino.receiver_valid", "flag", valid, good),
    new Row(list, "IMU", "arduino.imu_valid", "flag", valid, good),
    new Row(
      list,
      "Gyro's bias",
      "arduino.bias_stored",
      "flag",
      (is) => (is ? "an old one" : "fresh"),
      bad,
    ),
    new Row(list, "Framing", "arduino.framing", "text"),
    new Row(list, "Loop", "arduino.loop_us", "number", us),
    new Row(list, "Late", "arduino.late_us", "number", us),
    new Row(list, "Frame errors", "arduino.frame_errors", "number", (value) => numberText(value)),
    new Row(list, "Last reset", "arduino.reset_cause", "value"),
    new Row(
      list,
      "Reset in flight",
      "arduino.restored",
      "flag",
      (is) => flagText(is, "YES", "no"),
      bad,
    ),
    new Row(list, "Processor", "load.cpu", "number", percent),
    new Row(list, "Memory", "load.ram", "number", percent),
    new Row(list, "Up runs for", "system.uptime_s", "number", uptimeText),
  ];
  return {
    update() {
      for (const row of rows) {
        row.update(store);
      }
    },
  };
}

/** As `41 s`, `12 min 05 s`, `3 h 20 min`. */
export function uptimeText(time_s) {
  const seconds = Math.max(0, Math.floor(time_s));
  const minutes = Math.floor(seconds / 60);
  if (minutes === 0) {
    return `${seconds} s`;
  }
  if (minutes < 60) {
    return `${minutes} min ${String(seconds % 60).padStart(2, "0")} s`;
  }
  return `${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, "0")} min`;
}
