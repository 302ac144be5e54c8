import { html, setAttribute } from "../dom.js";
import { freshnessOf, Readout, Row } from "../readout.js";
import { numberText } from "../state/format.js";
import { LIMITS } from "../state/schema.js";

const WARNING_PERCENT = 35;

/** The batteries on board: the level of the phone's, the voltage of the flight battery. */
export function mount(element, store) {
  const value = html("span", { class: "battery-value" });
  const age = html("span", { class: "age" });
  const fill = html("span", { class: "battery-fill" });
  const cell = html("span", { class: "battery-cell", "aria-hidden": "true" }, fill);
  const list = html("dl", { class: "rows" });
  element.append(html("p", { class: "battery-head" }, cell, value, age), list);
  const percentText = (level) => `${numberText(level)} %`;
  const readout = new Readout(value, "android.batteryLevel", percentText, age, "number");
  const phone = new Row(
    list,
    "Phone",
    "android.connected",
    "flag",
    (isThere) => (isThere ? "connected" : "absent"),
    (isThere) => (isThere ? "" : "warning"),
  );
  const flight = new Row(
    list,
    "Flight battery",
    "arduino.flight_battery_v",
    "number",
    (voltage) => `${numberText(voltage, 2)} V`,
    () => flightBatteryLevel(store),
  );
  return {
    update() {
      flight.update(store);
      const level = readout.update(store);
      phone.update(store);
      const percent = Math.max(0, Math.min(100, level ?? 0));
      const freshness = freshnessOf(store, level, "battery");
      setAttribute(cell, "data-freshness", freshness);
      const judged = freshness === "none" ? "" : batteryLevel(percent);
      setAttribute(cell, "data-level", judged);
      setAttribute(value, "data-level", judged);
      const transform = `scaleX(${(percent / 100).toFixed(2)})`;
      if (fill.shownTransform !== transform) {
        fill.shownTransform = transform;
        fill.style.transform = transform;
      }
    },
  };
}

/** The look of the voltage by the limits of the aircraft. */
export function flightBatteryLevel(store) {
  if (store.flag("arduino.flight_battery_critical")) {
    return "alarm";
  }
  return store.flag("arduino.flight_battery_low") ? "warning" : "";
}

export function batteryLevel(percent) {
  return percent < LIMITS.battery_low ? "alarm" : percent < WARNING_PERCENT ? "warning" : "";
}
