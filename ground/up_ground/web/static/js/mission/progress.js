import { FENCE, MISSION } from "./plan.js";

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

/** As `Item 3 of 12 is next, 340 m.`; empty: no mission. */
export function progressText(store) {
  const count = store.number(`${MISSION}.count`);
  const item = store.number(`${MISSION}.item`);
  if (!count || item === null) {
    return "";
  }
  if (store.flag(`${MISSION}.is_finished`) === true) {
    return `Finished: all ${count} items.`;
  }
  const distance_m = store.number(`${MISSION}.distance`);
  return `Item ${item} of ${count}${distance_m === null ? "" : `, ${Math.round(distance_m)} m ahead`}.`;
}
