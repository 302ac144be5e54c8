import { DRIFT } from "../state/schema.js";
import { number } from "../state/validate.js";

const DOUBT_S = 0.1;
const ROUNDING_S = 0.005;

/**
 * Transit time of the server's messages to this page, by the clock of each.
 *
 * The quickest message bounds the offset of the two clocks on one side, a request and its answer on
 * the other. If the bounds are close, their middle is taken; if they are far apart, something is
 * queued, and the whole delay is attributed to the way here. So the computed age of a message is at
 * most 0.1 s too small, and too great by at most the time of the quickest request. Only the drift
 * of the clocks is forgotten: a queue may stand for hours.
 */
export class OneWayDelayEstimator {
  #most_s = null;
  #least_s = -Infinity;
  #now_s = 0;

  /** The transit time, s, of a message sent at sent_ms (server), asked for at asked_s; null: no server clock. */
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
      // A clock stood still, as in sleep: the bounds belong to other clocks.
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
