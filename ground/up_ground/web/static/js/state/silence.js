/** Longer gaps interrupt a line; a slow period extends the limit. */
export const GAP_S = 0.9;

/** Number of intervals for the median period; a silence among them does not change it. */
const INTERVALS = 5;

/** Detects a silence from the period of the arrivals. */
export class Silence {
  #last_s = null;
  #intervals_s = [];

  /** Minimum duration of a silence, seconds. */
  get limit_s() {
    const known = this.#intervals_s;
    const period_s = known.length < INTERVALS ? 0 : known.toSorted((a, b) => a - b)[INTERVALS >> 1];
    return Math.max(GAP_S, 2.5 * period_s);
  }

  /** Take an arrival. Returns whether there was a silence before it. */
  take(time_s) {
    const since_s = this.#last_s === null ? 0 : time_s - this.#last_s;
    const wasSilent = since_s > this.limit_s;
    if (this.#last_s !== null) {
      this.#intervals_s = [...this.#intervals_s, since_s].slice(-INTERVALS);
    }
    this.#last_s = time_s;
    return wasSilent;
  }

  /** Forget all arrivals. from_s: a silence counts from then on; null: from the next arrival. */
  clear(from_s = null) {
    this.#last_s = from_s;
    this.#intervals_s = [];
  }
}
