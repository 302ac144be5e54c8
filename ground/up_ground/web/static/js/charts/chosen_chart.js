import { element } from "../panels/element.js";
import { readingOf } from "../state/ages.js";
import * as judge from "../state/judge.js";
import { chartChoice } from "./chart_choice.js";
import { History } from "./history.js";
import { LineChart } from "./line_chart.js";

const LONGEST_TITLE = 60;

/** One more chart, of a value that the user has chosen in the list of all telemetry. */
export class ChosenChart {
  #UPlot;
  #history = new History(["value"]);
  #keys = null;
  #chart = null;

  constructor(UPlot) {
    this.#UPlot = UPlot;
    this.element = element("div.chosen-chart", { id: "chosen-chart", hidden: true });
    this.#follow();
  }

  /** Draw no line between the samples before and after this call. */
  clear() {
    this.#history.clear();
  }

  /** Take the newest frame. time_s: when it was so. */
  take(store, time_s) {
    this.#follow();
    if (this.#keys !== null) {
      const isLive = store.freshness(readingOf(this.#keys[0])) === "live";
      const value = judge.number(judge.atKeys(store.data, this.#keys));
      this.#history.add(time_s, { value: isLive ? value : null });
    }
  }

  show(now_s) {
    this.#follow();
    this.#chart?.show(this.#history.columns(now_s));
  }

  #follow() {
    const { keys } = chartChoice;
    if (keys === this.#keys) {
      return;
    }
    this.#keys = keys;
    this.#history.clear();
    this.#chart?.end();
    this.#chart = null;
    this.element.replaceChildren();
    this.element.hidden = keys === null;
    if (keys !== null) {
      const title = keys.join(".").slice(0, LONGEST_TITLE);
      const lines = [{ name: "value", label: "is", colour: "--accent" }];
      this.#chart = new LineChart(this.#UPlot, { title, unit: "", decimals: null, leastSpan: null, lines });
      this.element.append(this.#chart.element, this.#closer(title));
    }
  }

  #closer(title) {
    return element("button.quiet", {
      type: "button",
      id: "chosen-chart-close",
      text: "Remove",
      "aria-label": `Remove the chart of ${title}`,
      on: { click: () => chartChoice.choose(null) || this.#follow() },
    });
  }
}
