import { html, setAttribute, setText, svg } from "../dom.js";
import { headingText, numberText } from "../state/format.js";

/** The wind beside the map, if the aircraft estimates it: an arrow along the wind, and text. */
export class Wind {
  #arrow = svg("path", { d: "M0 -7 V7 M-4 3 L0 7 L4 3" });
  #words = html("span");

  constructor() {
    const arrow = svg("svg", { viewBox: "-8 -8 16 16", width: 24, height: 24 }, this.#arrow);
    setAttribute(arrow, "aria-hidden", "true");
    this.element = html("p.map-wind", { id: "map-wind", title: "The direction the wind comes from; its speed, two standard deviations", hidden: true }, arrow, this.#words);
  }

  show(store) {
    const from_deg = store.number("navigation.wind.from");
    const speed_m_s = store.number("navigation.wind.speed");
    this.element.hidden = from_deg === null || speed_m_s === null;
    if (!this.element.hidden) {
      const sd_m_s = store.number("navigation.sd.wind");
      const spread = sd_m_s === null ? "" : `\u00a0±${numberText(2 * sd_m_s, 1)}`;
      setAttribute(this.#arrow, "transform", `rotate(${from_deg.toFixed(0)})`);
      setText(this.#words, `Wind ${headingText(from_deg)}°, ${numberText(speed_m_s, 1)}${spread}\u00a0m/s`);
      setAttribute(this.element, "data-freshness", store.freshness("navigation"));
    }
  }
}
