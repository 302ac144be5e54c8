import { html } from "../dom.js";
import { Row } from "../readout.js";
import { flagText, numberText } from "../state/format.js";
import { BOARD_ROWS } from "../state/schema.js";

/** The Arduino as it sees itself, and how busy the Raspberry Pi is. */
export function mount(element, store) {
  const list = html("dl", { class: "rows" });
  element.append(list);
  const rows = BOARD_ROWS.map(
    (row) => new Row(list, row.label, row.path, row.kind, formatOf(row), styleOf(row)),
  );
  return {
    update() {
      for (const row of rows) {
        row.update(store);
      }
    },
  };
}

function formatOf({ kind, unit, yes, no }) {
  if (kind === "flag") {
    return (value) => flagText(value, yes, no);
  }
  if (unit === "s") {
    return uptimeText;
  }
  return kind === "number" ? (value) => `${numberText(value)} ${unit}`.trim() : String;
}

function styleOf({ style, when }) {
  return (value) => (style !== "" && value === when ? style : "");
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
