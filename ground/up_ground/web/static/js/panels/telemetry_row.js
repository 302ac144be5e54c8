import { setAttribute, setText } from "../readout.js";
import { readingOf } from "../state/ages.js";
import { ageText } from "../state/format.js";
import { element } from "./element.js";
import { pathWords, valueWords } from "./telemetry_leaves.js";

const CHANGED_S = 1;

/** One value of the telemetry in the list: path, value, whether it changed, its age. */
export class TelemetryRow {
  #value;
  #age = element("span.age");
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
    const last = pathWords(keys.at(-1));
    const before = keys.length > 1 ? `${pathWords(keys.slice(0, -1).join("."))}.` : "";
    this.#value = element("span.leaf-value", { "data-key": path });
    this.element = element(
      "li",
      {},
      element("span.leaf-path", {}, element("span.quiet", { text: before }), last),
      this.#value,
      this.#age,
    );
  }

  /** isDrawn: whether it is in the chart. */
  show(value, store, isDrawn) {
    const words = valueWords(value);
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
      const path = pathWords(this.keys.join("."));
      this.#button = element("button.quiet", {
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
