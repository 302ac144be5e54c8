import { drawn, element } from "../panels/element.js";
import { setAttribute, setText } from "../readout.js";

/** The wind beside the map, if the aircraft reports it: an arrow along the wind, and text. */
export class Wind {
  #arrow = drawn("path", { d: "M0 -7 V7 M-4 3 L0 7 L4 3" });
  #words = element("span");

  constructor() {
    const arrow = drawn("svg", { viewBox: "-8 -8 16 16", width: 16, height: 16 }, this.#arrow);
    setAttribute(arrow, "aria-hidden", "true");
    this.element = element("p.map-wind", { hidden: true }, arrow, this.#words);
  }

  /** store: `wind.from` in degrees, `wind.speed` in m/s. */
  show(store) {
    const from_deg = store.number("wind.from");
    const speed_m_s = store.number("wind.speed");
    this.element.hidden =
      from_deg === null || speed_m_s === null || store.freshness(null) !== "live";
    if (!this.element.hidden) {
      setAttribute(this.#arrow, "transform", `rotate(${from_deg.toFixed(0)})`);
      setText(this.#words, `wind ${speed_m_s.toFixed(1)} m/s from ${from_deg.toFixed(0)}°`);
    }
  }
}
