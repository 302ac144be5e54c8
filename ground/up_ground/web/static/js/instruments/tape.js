import { hatch, setAttribute, setText, short, svg } from "../dom.js";
import { UNKNOWN } from "../state/format.js";

const HEIGHT = 280;

/** A tape of numbers behind a window that shows the value itself. */
export class Tape {
  #scale;
  #marks;
  #labels;
  #moving;
  #first = null;
  #number;
  #note;
  #foot;
  #footNote;
  #label;

  /** each: how many steps between labels; isLeft: the marks point to the middle of the picture. */
  constructor(form) {
    const { x, width, isLeft, key } = form;
    this.#scale = new TapeScale({ step: form.step, units: form.units, height: HEIGHT });
    this.#label = (value) => labelText(value, form);
    const edge = isLeft ? x + width : x;
    const inward = isLeft ? -1 : 1;
    this.#marks = [];
    this.#labels = [];
    this.#moving = svg("g");
    for (let place = 0; place < this.#scale.count; place += 1) {
      const y = this.#scale.y(place);
      const mark = svg("path", { class: "tape-mark" });
      const kind = `tape-label ${isLeft ? "is-right" : "is-left"}`;
      const label = svg("text", { x: edge + inward * 12, y: y + 4, class: kind });
      this.#marks.push({ mark, edge, inward, y });
      this.#labels.push(label);
      this.#moving.append(mark, label);
    }
    const clip = `tape-${isLeft ? "left" : "right"}`;
    const box = { x, y: -HEIGHT / 2, width, height: HEIGHT };
    this.#number = svg("text", { y: 6, class: "tape-number", "data-key": key });
    this.#number.setAttribute("x", isLeft ? x + width - 8 : x + width - 6);
    this.element = svg(
      "g",
      { class: "tape" },
      svg("defs", {}, svg("clipPath", { id: clip }, svg("rect", box))),
      svg("rect", { ...box, class: "tape-ground" }),
      svg("g", { "clip-path": `url(#${clip})`, "aria-hidden": "true" }, this.#moving),
      hatch(`${clip}-hatch`, box),
      svg("path", { d: windowPath(x, width, isLeft), class: "tape-window" }),
      this.#number,
      svg("rect", { x, y: -140, width, height: 32, class: "tape-cap" }),
      svg("text", { x: x + width / 2, y: -127, class: "tape-title" }, form.title),
    );
    this.unit = form.unit;
    this.#note = svg("text", { x: x + width / 2, y: -114, class: "tape-unit" }, form.unit);
    this.#foot = svg("text", { x: x + width / 2, y: 123, class: "tape-foot" });
    this.#footNote = svg("text", { x: x + width / 2, y: 135, class: "tape-unit" });
    const foot = svg("rect", { x, y: 108, width, height: 32, class: "tape-cap" });
    this.element.append(this.#note, foot, this.#foot, this.#footNote);
  }

  /** text: a second value below the tape; empty: none; note: what it is. */
  showFoot(text, note, freshness) {
    setText(this.#foot, text);
    setText(this.#footNote, text && note);
    setAttribute(this.#foot, "data-freshness", freshness);
  }

  /** text: of the window; age: of a stale value as text, otherwise "". */
  show(value, freshness, text, age) {
    setAttribute(this.element, "data-freshness", freshness);
    setAttribute(this.#number, "data-freshness", freshness);
    setText(this.#number, value === null ? UNKNOWN : text);
    setText(this.#note, age === "" ? this.unit : age);
    setAttribute(this.#note, "data-old", String(age !== ""));
    if (value === null) {
      return;
    }
    const { first, shift } = this.#scale.at(value);
    setAttribute(this.#moving, "transform", `translate(0 ${short(shift)})`);
    if (first !== this.#first) {
      this.#first = first;
      this.#relabel(first);
    }
  }

  #relabel(first) {
    this.#marks.forEach(({ mark, edge, inward, y }, place) => {
      const text = this.#label(first + place * this.#scale.step);
      const length = text === null ? 0 : text === "" ? 5 : 9;
      setAttribute(mark, "d", `M${edge} ${y}h${inward * length}`);
      setText(this.#labels[place], text ?? "");
    });
  }
}

function labelText(value, { step, each, least = -Infinity }) {
  if (value < least) {
    return null;
  }
  return Math.round(value / step) % each === 0 ? String(Math.round(value)) : "";
}

function windowPath(x, width, isLeft) {
  return isLeft
    ? `M${x} -15H${x + width - 5}V-6L${x + width + 3} 0L${x + width - 5} 6V15H${x}Z`
    : `M${x + width} -15H${x + 5}V-6L${x - 3} 0L${x + 5} 6V15H${x + width}Z`;
}

/**
 * A scale that moves past a pointer, greater values above.
 *
 * Only changes are reported: `first` is the lowest mark drawn and stays the same until the value
 * has moved by a whole step; in between only `shift` changes.
 */
export class TapeScale {
  /** step: between marks; units: of the drawing for a step; height: of the drawing. */
  constructor({ step, units, height }) {
    this.step = step;
    this.units = units;
    this.count = 2 * (Math.ceil(height / 2 / units) + 1) + 1;
  }

  /** value: at the pointer. Returns shift: how far down the marks move. */
  at(value) {
    const middle = Math.round(value / this.step);
    const below = (this.count - 1) / 2;
    return {
      first: (middle - below) * this.step,
      shift: (value / this.step - middle) * this.units,
    };
  }

  /** place: of a mark, counted from the lowest. Returns where it is drawn while the shift is 0. */
  y(place) {
    return ((this.count - 1) / 2 - place) * this.units;
  }
}
