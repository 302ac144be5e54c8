import { html } from "../dom.js";
import { clockText } from "../panels/messages.js";
import { PlainRow, Row } from "../readout.js";
import { numberText } from "../state/format.js";
import { FlightTimer } from "../state/flight_timer.js";
import { NAVIGATION_ROWS } from "../state/schema.js";

/** The flight's time, and where the aircraft is by its own estimate. */
export function mount(element, store) {
  const list = html("dl", { class: "rows" });
  element.append(list);
  const timer = new FlightTimer();
  const flight = new PlainRow(list, "In flight for", "flight.time");
  const rows = NAVIGATION_ROWS.map(
    ({ label, path, unit, decimals, optional }) =>
      new Row(list, label, path, "number", formatOf(unit, decimals), undefined, optional),
  );
  return {
    update() {
      const flown = timer.update(store);
      const text = flown === null ? null : `${flown.isExact ? "" : "at least "}${clockText(flown.time_s)}`;
      flight.show(text, "", store.freshness("flight") !== "live");
      for (const row of rows) {
        row.update(store);
      }
    },
  };
}

function formatOf(unit, decimals) {
  if (unit === "s") {
    return clockText;
  }
  const suffix = unit === "deg" ? "°" : unit && ` ${unit}`;
  return (value) => `${numberText(value, decimals)}${suffix}`;
}
