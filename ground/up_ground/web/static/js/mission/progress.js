import { actingMode } from "../state/flight_mode.js";
import { plainNumber } from "../state/format.js";
import { FENCE, MISSION } from "./plan.js";

/** What the modes that replace MISSION at an item do with it. */
const REPLACING = { LAND: "Landing", RETURN: "Returning", TAKEOFF: "Taking off" };

/**
 * Whether the aircraft has the drawn plan: `unknown` (it reports none of its plans), `none` (it has
 * no plan), `same`, `other`, `undrawn` (it has one, and nothing is drawn).
 */
export function usedState(editor, store, name) {
  const id = store.text(`${name}.id`);
  const count = store.number(`${name}.count`);
  if (count === null && id === null) {
    return "unknown";
  }
  if (!id || count === 0) {
    return "none";
  }
  if (editor.drawn[name].length === 0) {
    return "undrawn";
  }
  return editor.isUsed(id, name) ? "same" : "other";
}

const FLIES = "MISSION";
const STATES = {
  unknown: (name) => `The aircraft reports no ${name}.`,
  none: (name) => `The aircraft has no ${name}.`,
  same: (name) => `The aircraft has this ${name}.`,
  undrawn: (name) => `The aircraft has a ${name}: Download draws it.`,
  other: (name) => `The aircraft has another ${name} than the drawn one: upload, or download its own.`,
};

/** What the aircraft has of the plan in work, and what it flies: {code, text}. */
export function flownItem(editor, store) {
  const { name } = editor;
  const code = usedState(editor, store, name);
  const progress = name === FENCE ? "" : progressText(store);
  return { code, text: [STATES[code](name), progress].filter(Boolean).join(" ") };
}

/** The limits of failsafe.yml, as `Limits around home: radius 300 m, ceiling 120 m.`; empty: none. */
export function limitsText(store) {
  const limits = ["radius", "ceiling", "floor"].map((name) => [name, store.number(`${FENCE}.${name}`)]);
  const parts = limits.filter(([, value_m]) => value_m !== null).map(([name, value_m]) => `${name} ${plainNumber(value_m)} m`);
  return parts.length === 0 ? "" : `Limits around and above home (failsafe.yml): ${parts.join(", ")}.`;
}

/** As `Item 3 of 12, 340 m ahead.`, `Landing: item 4 of 4.`, `Landing; item 2 of 4 is next.`, `Item 3 of 12 is next.`; empty: no mission. */
export function progressText(store) {
  const count = store.number(`${MISSION}.count`);
  const item = store.number(`${MISSION}.item`);
  if (!count || item === null) {
    return "";
  }
  if (store.flag(`${MISSION}.is_finished`) === true) {
    return `Finished: all ${count} items.`;
  }
  const mode = actingMode(store);
  if (Object.hasOwn(REPLACING, mode)) {
    // An item with such a mode is the first one (TAKEOFF) or the last one; elsewhere the ground or a failsafe chose it.
    const isItem = item === (mode === "TAKEOFF" ? 1 : count);
    return isItem ? `${REPLACING[mode]}: item ${item} of ${count}.` : `${REPLACING[mode]}; item ${item} of ${count} is next.`;
  }
  const distance_m = store.number(`${MISSION}.distance`);
  const away = distance_m === null ? "" : `, ${Math.round(distance_m)} m ${mode === FLIES ? "ahead" : "away"}`;
  return `Item ${item} of ${count}${mode === FLIES ? "" : " is next"}${away}.`;
}
