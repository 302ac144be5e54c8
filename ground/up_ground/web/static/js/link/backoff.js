const FIRST_S = 0.25;
const LONGEST_S = 2;

/** How long to wait before the next attempt: 0.25 s, doubled up to 2 s. */
export class Backoff {
  #attempts = 0;

  /** How many attempts failed since the last success. */
  get attempts() {
    return this.#attempts;
  }

  /** The seconds to wait now; each call counts one failure. */
  next_s() {
    const wait_s = Math.min(LONGEST_S, FIRST_S * 2 ** this.#attempts);
    this.#attempts = Math.min(this.#attempts + 1, 1000);
    return wait_s;
  }

  /** Reset: the server was reached. */
  reset() {
    this.#attempts = 0;
  }
}
