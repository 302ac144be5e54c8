import { html, setAttribute, setText } from "../dom.js";
import { readingOf } from "../state/newest_frame.js";
import { ageText, plainNumber } from "../state/format.js";

export const MAX_LEAVES = 1000;
const MAX_DEPTH = 24;
const MAX_TEXT = 160;
const MAX_PATH = 200;
// Invisible characters and those that change the text direction: shown by their number.
const UNSEEN = /[\p{Cc}\p{Cf}\p{Cs}\p{Co}\p{Zl}\p{Zp}]/gu;

/** Every value of a tree of telemetry, in its order; an empty object or list is a value. */
export function leavesOf(tree) {
  const leaves = [];
  let isCut = false;

  function walk(value, keys) {
    if (leaves.length >= MAX_LEAVES) {
      isCut = true;
      return;
    }
    const isBranch = value !== null && typeof value === "object" && keys.length < MAX_DEPTH;
    const names = isBranch ? Object.keys(value) : [];
    if (names.length === 0) {
      leaves.push({ path: keys.join("."), keys, value });
      return;
    }
    for (const name of names) {
      if (isCut) {
        return;
      }
      walk(value[name], [...keys, name]);
    }
  }

  if (tree !== null && typeof tree === "object" && Object.keys(tree).length > 0) {
    walk(tree, []);
  }
  return { leaves, isCut };
}

/** value: of any JSON type. Returns short, on one line, without anything that is not seen. */
export function valueText(value) {
  if (typeof value === "number") {
    return plainNumber(value);
  }
  if (typeof value === "string") {
    return `"${shown(value, MAX_TEXT)}"`;
  }
  return shown(JSON.stringify(value) ?? "", MAX_TEXT);
}

/** Short, without anything that is not seen. */
export function pathText(path) {
  return shown(path, MAX_PATH);
}

/** filter: words; each must be in the path, whatever its case. */
export function matches(path, filter) {
  const low = path.toLowerCase();
  return filter
    .toLowerCase()
    .split(/\s+/)
    .every((word) => low.includes(word));
}

function shown(text, longest) {
  const cut = text.length > longest ? `${text.slice(0, longest)}...` : text;
  return cut.replace(UNSEEN, (each) => `\\u{${each.codePointAt(0).toString(16)}}`);
}

const CHANGED_S = 1;

/** One value of the telemetry in the list: path, value, whether it changed, its age. */
export class TelemetryRow {
  #value;
  #age = html("span.age");
  #button = null;
  #draw;
  #reading;
  #words = null;
  #changedAt_s = -Infinity;

  /** draw: draws it in the chart, or no longer. */
  constructor({ path, keys }, draw) {
    this.keys = keys;
    this.#draw = draw;
    this.#reading = readingOf(path);
    const last = pathText(keys.at(-1));
    const before = keys.length > 1 ? `${pathText(keys.slice(0, -1).join("."))}.` : "";
    this.#value = html("span.leaf-value", { "data-key": path });
    this.element = html(
      "li",
      {},
      html("span.leaf-path", {}, html("span.quiet", { text: before }), last),
      this.#value,
      this.#age,
    );
  }

  show(value, store, isDrawn) {
    const words = valueText(value);
    if (words !== this.#words) {
      // A value listed for the first time has not changed.
      this.#changedAt_s = this.#words === null ? -Infinity : store.now_s;
      this.#words = words;
    }
    // A value whose reading never arrived is in the frame all the same: it is not fresh.
    const isLive = store.freshness(null) === "live" && store.freshness(this.#reading) === "live";
    setText(this.#value, words);
    setAttribute(this.#value, "data-freshness", isLive ? "live" : "stale");
    const hasChanged = isLive && store.now_s - this.#changedAt_s < CHANGED_S;
    setAttribute(this.element, "data-changed", String(hasChanged));
    setText(this.#age, isLive ? "" : ageText(store.age_s(this.#reading) ?? store.age_s(null)));
    this.#offer(typeof value === "number", isDrawn);
  }

  #offer(isNumber, isDrawn) {
    if (isNumber && this.#button === null) {
      const path = pathText(this.keys.join("."));
      this.#button = html("button.quiet", {
        type: "button",
        text: "Chart",
        "aria-label": `Chart ${path}`,
        on: { click: () => this.#draw(this.keys) },
      });
      this.element.append(this.#button);
    }
    if (this.#button !== null) {
      this.#button.hidden = !isNumber;
      setAttribute(this.#button, "aria-pressed", String(isDrawn));
    }
  }
}
