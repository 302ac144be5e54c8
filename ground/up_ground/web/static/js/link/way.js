import { number } from "../state/judge.js";

const DRIFT = 1e-4;
const DOUBT_S = 0.1;
const ROUNDING_S = 0.005;

/**
 * How long messages of the server are on their way to this page, by the clock of each.
 *
 * The quickest message bounds what lies between the two clocks from one side, a question and its
 * answer from the other. Where the bounds are near, the truth is taken to be in their middle; where
 * they are far apart, something stands in a queue, and it is taken to be the way here. So no
 * message is told younger than it is by more than 0.1 s, nor older by more than the quickest
 * question took. Nothing is forgotten but the drift of the clocks: a queue may stand for hours.
 */
export class Way {
  #most_s = null;
  #least_s = -Infinity;
  #now_s = 0;

  /**
   * @param {unknown} sent_ms the server's clock when the message left
   * @param {number} now_s the page's clock when it came
   * @param {number|null} asked_s the page's clock when it asked for this message, if it did
   * @returns {number|null} how long it was on its way, in seconds; null: it tells no clock
   */
  take(sent_ms, now_s, asked_s = null) {
    const stamp_ms = number(sent_ms);
    if (stamp_ms === null) {
      return null;
    }
    const apart_s = now_s - stamp_ms / 1000;
    const drift_s = DRIFT * (now_s - this.#now_s);
    this.#now_s = now_s;
    this.#most_s = this.#most_s === null ? apart_s : Math.min(apart_s, this.#most_s + drift_s);
    this.#least_s -= drift_s;
    if (asked_s !== null) {
      this.#least_s = Math.max(this.#least_s, asked_s - stamp_ms / 1000);
    }
    if (this.#least_s > this.#most_s + ROUNDING_S) {
      // A clock stood still, as in sleep: what was known is of other clocks.
      this.#most_s = apart_s;
      this.#least_s = asked_s === null ? -Infinity : asked_s - stamp_ms / 1000;
    }
    return apart_s - this.#most_s + this.#quickest_s();
  }

  #quickest_s() {
    if (this.#least_s === -Infinity) {
      return 0;
    }
    const both_s = Math.max(0, this.#most_s - this.#least_s);
    return Math.max(both_s / 2, both_s - DOUBT_S);
  }
}
