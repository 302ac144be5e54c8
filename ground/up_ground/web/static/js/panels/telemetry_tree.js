import { chartChoice } from "../charts/chosen_chart.js";
import { html, setText } from "../dom.js";
import { leavesOf, matches, MAX_LEAVES, pathText, TelemetryRow } from "./telemetry_row.js";
import { Pace } from "../readout.js";
import { ageText } from "../state/format.js";

/** Every value of the newest frame, also those that no other part of the page knows. */
export function mount(place, store) {
  const filter = html("input", {
    id: "telemetry-filter",
    type: "search",
    autocomplete: "off",
    spellcheck: "false",
    placeholder: "words of the path",
    on: { input: () => show() },
  });
  const count = html("p.quiet", { id: "telemetry-count" });
  const note = html("p.note", { id: "telemetry-note", role: "status" });
  const list = html("ul.leaves", { id: "telemetry-list" });
  const details = html(
    "details",
    { id: "telemetry", on: { toggle: () => toggled() } },
    html("summary", {}, place.querySelector("h2")),
    html("div.field", {}, html("label", { for: "telemetry-filter", text: "Filter" }), filter),
    count,
    note,
    list,
  );
  place.append(details);
  const pace = new Pace();
  const rows = new Map();
  let order = "";
  let aircraft = store.aircraft;

  function toggled() {
    if (details.open) {
      show();
    } else {
      clear();
    }
  }

  // A closed branch shows nothing, not even its last value.
  function clear() {
    rows.clear();
    list.replaceChildren();
    order = "";
  }

  function draw(keys) {
    const isDrawn = chartChoice.is(keys);
    chartChoice.choose(isDrawn ? null : keys);
    setText(note, isDrawn ? "" : `${pathText(keys.join("."))} is drawn under Charts.`);
    show();
  }

  function show() {
    const { leaves, isCut } = leavesOf(store.data);
    const chosen = leaves.filter(({ path }) => matches(path, filter.value));
    arrange(chosen);
    for (const leaf of chosen) {
      rows.get(keyOf(leaf)).show(leaf.value, store, chartChoice.is(leaf.keys));
    }
    setText(count, countText(chosen.length, leaves.length, isCut));
  }

  function countText(shown, all, isCut) {
    if (all === 0) {
      return "No telemetry came yet.";
    }
    const old = store.isSilent ? `, ${ageText(store.age_s(null))} old` : "";
    const more = isCut ? ` (the frame has more: the first ${MAX_LEAVES} are here)` : "";
    return `${shown} of ${all} values of the newest frame${old}${more}`;
  }

  function arrange(leaves) {
    const keys = leaves.map(keyOf);
    const now = keys.join("\n");
    if (now === order) {
      return;
    }
    order = now;
    const kept = new Set(keys);
    for (const [key, row] of rows) {
      if (!kept.has(key)) {
        row.element.remove();
        rows.delete(key);
      }
    }
    // Only misplaced rows move, so that a button keeps the focus.
    let next = list.firstElementChild;
    leaves.forEach((leaf, index) => {
      const row = rows.get(keys[index]) ?? new TelemetryRow(leaf, draw);
      rows.set(keys[index], row);
      if (row.element === next) {
        next = next.nextElementSibling;
      } else {
        list.insertBefore(row.element, next);
      }
    });
  }

  return {
    update() {
      if (store.aircraft !== aircraft) {
        aircraft = store.aircraft;
        clear();
      }
      if (details.open && !document.hidden && pace.isTime(store.now_s)) {
        show();
      }
    },
  };
}

// Keys may have dots in them: two values may have one path.
function keyOf({ keys }) {
  return JSON.stringify(keys);
}
