const PERIOD_S = 0.2;

/** Limits displayed ages to five changes a second: faster ones cannot be read. */
export class Pace {
  #next_s = -Infinity;

  /** Whether it is time to write them again. */
  isTime(now_s) {
    if (now_s < this.#next_s) {
      return false;
    }
    this.#next_s = now_s + PERIOD_S * 0.9;
    return true;
  }
}
