import { html, setAttribute, setText } from "../dom.js";
import { freshnessOf, oldText, Readout } from "../readout.js";
import { readingOf } from "../state/newest_frame.js";
import { numberText } from "../state/format.js";

const CHANNELS = ["ailerons", "elevator", "throttle", "rudder", "aux1", "aux2"];
const MIDDLE_US = 1500;
const HALF_US = 500;

/** Receiver inputs and servo outputs, channel by channel, 1000 to 2000 us. */
export function mount(element, store) {
  const table = html("div", { class: "channel-table" });
  const heads = { rx: headOf("in"), servo: headOf("out") };
  table.append(html("span"), heads.rx.element, heads.servo.element);
  const cells = [];
  for (const channel of CHANNELS) {
    table.append(html("span", { class: "channel-name" }, channel));
    cells.push(new Cell(table, `rx.${channel}`, channel));
    if (channel.startsWith("aux")) {
      table.append(html("span"));
    } else {
      cells.push(new Cell(table, `servo.${channel}`, channel));
    }
  }
  element.append(table);
  return {
    update() {
      for (const cell of cells) {
        cell.update(store);
      }
      for (const [reading, { age }] of Object.entries(heads)) {
        setText(age, oldText(store, reading, store.freshness(reading)));
      }
    },
  };
}

function headOf(name) {
  const age = html("span", { class: "age" });
  return { age, element: html("span", { class: "channel-head" }, name, " ", age) };
}

/** A bar from the middle (the throttle's from its end) and the pulse in figures. */
class Cell {
  #path;
  #bar;
  #fill;
  #readout;
  #isThrottle;

  constructor(table, path, channel) {
    this.#path = path;
    this.#isThrottle = channel === "throttle";
    this.#fill = html("span", { class: "bar-fill" });
    this.#bar = html("span", { class: "bar", "aria-hidden": "true" }, this.#fill);
    this.#bar.classList.toggle("is-from-end", this.#isThrottle);
    const value = html("span", { class: "bar-value" });
    this.#readout = new Readout(value, path, (pulse_us) => numberText(pulse_us), null, "number");
    table.append(html("span", { class: "channel-cell" }, this.#bar, value));
  }

  update(store) {
    const pulse_us = this.#readout.update(store);
    setAttribute(this.#bar, "data-freshness", freshnessOf(store, pulse_us, readingOf(this.#path)));
    if (pulse_us === null) {
      return;
    }
    const limited = Math.max(-1, Math.min(1, share(pulse_us)));
    const scale = this.#isThrottle ? (limited + 1) / 2 : limited;
    const transform = `scaleX(${scale.toFixed(3)})`;
    if (this.#bar.shownTransform !== transform) {
      this.#bar.shownTransform = transform;
      this.#fill.style.transform = transform;
    }
    setAttribute(this.#bar, "data-beyond", beyond(pulse_us));
  }
}

/** -1 at 1000 us, 0 at 1500 us, 1 at 2000 us, and not beyond 1.1. */
export function share(pulse_us) {
  return Math.max(-1.1, Math.min(1.1, (pulse_us - MIDDLE_US) / HALF_US));
}

/** Whether it lies beyond the scale of 1000 to 2000 us. */
export function beyond(pulse_us) {
  return pulse_us < MIDDLE_US - HALF_US
    ? "low"
    : pulse_us > MIDDLE_US + HALF_US
      ? "high"
      : "within";
}
