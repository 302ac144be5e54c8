import { keepsakeOf } from "../link/keepsake.js";

const KEY = "chart";
const MOST_KEYS = 24;

/** Which value of the telemetry the chart of one's own choice draws; the browser remembers it. */
export class ChartChoice {
  #memory;
  #keys;

  /** memory: with get and set. */
  constructor(memory) {
    this.#memory = memory;
    this.#keys = keysOf(memory.get(KEY));
  }

  /** The way to the value; null: none is chosen. */
  get keys() {
    return this.#keys;
  }

  /** Whether this one is drawn. */
  is(keys) {
    return this.#keys !== null && this.#keys.length === keys.length && this.#keys.every((each, index) => each === keys[index]);
  }

  /** keys: null: no chart. */
  choose(keys) {
    this.#keys = keys;
    this.#memory.set(KEY, keys === null ? "" : JSON.stringify(keys));
  }
}

/** The page's choice. */
export const chartChoice = new ChartChoice(keepsakeOf("localStorage"));

function keysOf(text) {
  try {
    const keys = JSON.parse(text || "null");
    const isGood =
      Array.isArray(keys) &&
      keys.length > 0 &&
      keys.length <= MOST_KEYS &&
      keys.every((each) => typeof each === "string");
    return isGood ? keys : null;
  } catch {
    return null;
  }
}
