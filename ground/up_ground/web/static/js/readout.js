import { html, setAttribute, setText } from "./dom.js";
import { readingOf } from "./state/newest_frame.js";
import { ageText, UNKNOWN } from "./state/format.js";

const PERIOD_S = 0.2;

/** Limits displayed ages to five changes a second: faster ones cannot be read. */
export class Pace {
  #next_s = -Infinity;

  /** Whether it is time to write them again. */
  isTime(now_s) {
    if (now_s < this.#next_s) {
      return false;
    }
    this.#next_s = now_s + PERIOD_S * 0.9;
    return true;
  }
}

/** The freshness of a value of a reading; null: there is no value. */
export function freshnessOf(store, value, reading) {
  return value === null ? "none" : store.freshness(reading);
}

/** The age of a stale reading; empty while it is not stale. */
export function oldText(store, reading, freshness) {
  return freshness === "stale" ? ageText(store.age_s(reading) ?? store.age_s(null)) : "";
}

/** A value of telemetry in an element: `data-key`, `data-freshness`, `--` without a value, the age if stale. */
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

  update(store) {
    const value = store[this.#kind](this.#path);
    const freshness = freshnessOf(store, value, this.#reading);
    setText(this.element, freshness === "none" ? UNKNOWN : this.#format(value));
    setAttribute(this.element, "data-freshness", freshness);
    if (this.ageElement !== null) {
      setText(this.ageElement, oldText(store, this.#reading, freshness));
    }
    return freshness === "none" ? null : value;
  }
}

/** One line of a list: its name, its value, its age while its reading is old. */
export class Row {
  #row;
  #readout;
  #validate;
  #isOptional;

  /** list: a `dl`; validate: the style of a live value: "" plain, "warning" or "alarm"; isOptional: hidden without a value. */
  constructor(list, name, path, kind, format = String, validate = () => "", isOptional = false) {
    const value = html("span", { class: "row-value" });
    const age = html("span", { class: "age" });
    this.#row = rowOf(name, value, age);
    this.#isOptional = isOptional;
    list.append(this.#row);
    const ownAge = readingOf(path) === null ? null : age;
    this.#readout = new Readout(value, path, format, ownAge, kind);
    this.#validate = validate;
  }

  update(store) {
    const value = this.#readout.update(store);
    this.#row.hidden = this.#isOptional && value === null;
    const level = value === null ? "" : this.#validate(value);
    setAttribute(this.#readout.element, "data-level", level);
  }
}

/** A line whose text comes from the page or its server, not from telemetry. */
export class PlainRow {
  #value;

  constructor(list, name, key) {
    this.#value = html("span", { class: "row-value", "data-key": key });
    list.append(rowOf(name, this.#value));
  }

  /** The value's code, for programs and tests. */
  setState(code) {
    setAttribute(this.#value, "data-state", code);
  }

  /** text: null: not known. */
  show(text, level = "", isOld = false) {
    setText(this.#value, text ?? "--");
    setAttribute(this.#value, "data-level", text === null ? "" : level);
    setAttribute(this.#value, "data-freshness", text === null ? "none" : isOld ? "stale" : "live");
  }
}

function rowOf(name, ...values) {
  return html("div.row", {}, html("dt", {}, name), html("dd", {}, ...values));
}
