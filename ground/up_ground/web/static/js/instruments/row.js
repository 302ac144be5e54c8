import { html, Readout, setAttribute, setText } from "../readout.js";
import { readingOf } from "../state/ages.js";

/**
 * One line of a list: its name, its value, its age while its reading is old.
 */
export class Row {
  #readout;
  #judge;

  /**
   * list: a `dl`; kind: a value of another type is ignored; judge: style of a live value: "" plain,
   * "warning" or "alarm".
   */
  constructor(list, name, path, kind, format = String, judge = () => "") {
    const value = html("span", { class: "row-value" });
    const age = html("span", { class: "age" });
    list.append(html("div", { class: "row" }, html("dt", {}, name), html("dd", {}, value, age)));
    const ownAge = readingOf(path) === null ? null : age;
    this.#readout = new Readout(value, path, format, ownAge, kind);
    this.#judge = judge;
  }

  update(store) {
    const value = this.#readout.update(store);
    const level = value === null ? "" : this.#judge(value);
    setAttribute(this.#readout.element, "data-level", level);
  }
}

/** A line whose text comes from the page or its server, not from telemetry. */
export class PlainRow {
  #value;

  constructor(list, name, key) {
    this.#value = html("span", { class: "row-value", "data-key": key });
    list.append(html("div", { class: "row" }, html("dt", {}, name), html("dd", {}, this.#value)));
  }

  /** text: null: not known. */
  show(text, level = "", isOld = false) {
    setText(this.#value, text ?? "--");
    setAttribute(this.#value, "data-level", text === null ? "" : level);
    setAttribute(this.#value, "data-freshness", text === null ? "none" : isOld ? "stale" : "live");
  }
}
