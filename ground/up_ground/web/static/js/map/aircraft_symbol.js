import { drawn } from "../panels/element.js";
import { setAttribute, setText } from "../readout.js";

const OUTLINE = "M0 -15 L2 -9 L2 -4 L15 3 L15 6 L2 3 L1.5 10 L5 13 L5 15 L0 14 L-5 15 L-5 13 L-1.5 10 L-2 3 L-15 6 L-15 3 L-2 -4 L-2 -9 Z";
const NO_HEADING = "M0 -9 A9 9 0 1 1 -0.01 -9 Z";

/** The aircraft as the map draws it: turned by its heading; without one it is a disc. */
export class AircraftSymbol {
  #outline = drawn("path", { d: NO_HEADING });
  #age = drawn("text", { x: 0, y: 30, "text-anchor": "middle" });

  constructor() {
    this.element = drawn(
      "svg.aircraft-symbol",
      { viewBox: "-18 -18 36 36", width: 40, height: 40, "aria-hidden": "true" },
      this.#outline,
      this.#age,
    );
  }

  /**
   * heading_deg: clockwise from north; age: how long ago it was seen there, written below while it
   * is not live.
   */
  show(heading_deg, freshness, age) {
    setAttribute(this.#outline, "d", heading_deg === null ? NO_HEADING : OUTLINE);
    setAttribute(this.#outline, "transform", `rotate(${(heading_deg ?? 0).toFixed(1)})`);
    setAttribute(this.element, "data-freshness", freshness);
    setText(this.#age, freshness === "live" ? "" : age);
  }
}
