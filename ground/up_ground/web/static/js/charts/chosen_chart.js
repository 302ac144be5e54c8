import { History } from "./history.js";
import { LineChart } from "./line_chart.js";
import { html } from "../dom.js";
import { storageOf } from "../link/storage.js";
import { readingOf } from "../state/newest_frame.js";
import * as validate from "../state/validate.js";

const KEY = "chart";
const MAX_KEYS = 24;

/** Which value of the telemetry the chart of one's own choice draws; the browser remembers it. */
export class ChartChoice {
  #memory;
  #keys;

  constructor(memory) {
    this.#memory = memory;
    this.#keys = keysOf(memory.get(KEY));
  }

  /** The way to the value; null: none is chosen. */
  get keys() {
    return this.#keys;
  }

  is(keys) {
    return this.#keys !== null && this.#keys.length === keys.length && this.#keys.every((each, index) => each === keys[index]);
  }

  choose(keys) {
    this.#keys = keys;
    this.#memory.set(KEY, keys === null ? "" : JSON.stringify(keys));
  }
}

export const chartChoice = new ChartChoice(storageOf("localStorage"));

function keysOf(text) {
  try {
    const keys = JSON.parse(text || "null");
    const isGood =
      Array.isArray(keys) &&
      keys.length > 0 &&
      keys.length <= MAX_KEYS &&
      keys.every((each) => typeof each === "string");
    return isGood ? keys : null;
  } catch {
    return null;
  }
}

const MAX_TITLE = 60;

/** One more chart, of a value that the user has chosen in the list of all telemetry. */
export class ChosenChart {
  #UPlot;
  #history = new History(["value"]);
  #keys = null;
  #chart = null;

  constructor(UPlot) {
    this.#UPlot = UPlot;
    this.element = html("div.chosen-chart", { id: "chosen-chart", hidden: true });
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
      const isLive = store.freshness(readingOf(this.#keys.join("."))) === "live";
      const value = validate.number(validate.atKeys(store.data, this.#keys));
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
      const title = keys.join(".").slice(0, MAX_TITLE);
      const lines = [{ name: "value", label: "is", colour: "--accent" }];
      this.#chart = new LineChart(this.#UPlot, { title, unit: "", decimals: null, leastSpan: null, lines });
      this.element.append(this.#chart.element, this.#closer(title));
    }
  }

  #closer(title) {
    return html("button.quiet", {
      type: "button",
      id: "chosen-chart-close",
      text: "Remove",
      "aria-label": `Remove the chart of ${title}`,
      on: { click: () => chartChoice.choose(null) || this.#follow() },
    });
  }
}
