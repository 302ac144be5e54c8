import { readingOf } from "./state/ages.js";
import { ageText, UNKNOWN } from "./state/format.js";

/** Writes a text into an element, only when it changed. */
export function setText(element, text) {
  if (element.shownText !== text) {
    element.textContent = text;
    element.shownText = text;
  }
}

/** Sets an attribute, only when it changed. */
export function setAttribute(element, name, value) {
  const shown = (element.shownAttributes ??= {});
  if (shown[name] !== value) {
    element.setAttribute(name, value);
    shown[name] = value;
  }
}

/** Makes a HTML element. */
export function html(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

/** otherwise: text while the reading is not stale. Returns age of a stale reading. */
export function oldText(store, reading, freshness, otherwise = "") {
  return freshness === "stale" ? ageText(store.age_s(reading) ?? store.age_s(null)) : otherwise;
}

/**
 * One value of the telemetry in an element: `data-key`, `data-freshness`, `--` without a value, and
 * its age in `ageElement` while it is stale.
 */
export class Readout {
  #path;
  #format;
  #reading;
  #kind;

  /** path: of the value; kind: a value of another type is ignored. */
  constructor(element, path, format = String, ageElement = null, kind = "value") {
    this.element = element;
    this.ageElement = ageElement;
    this.#path = path;
    this.#format = format;
    this.#kind = kind;
    this.#reading = readingOf(path);
    element.setAttribute("data-key", path);
  }

  /** The value shown, null: none. */
  update(store) {
    const value = store[this.#kind](this.#path);
    const freshness = value === null ? "none" : store.freshness(this.#reading);
    setText(this.element, freshness === "none" ? UNKNOWN : this.#format(value));
    setAttribute(this.element, "data-freshness", freshness);
    if (this.ageElement !== null) {
      setText(this.ageElement, oldText(store, this.#reading, freshness));
    }
    return freshness === "none" ? null : value;
  }
}
