/** Seconds since the page began: the clock of every age, which never jumps with the wall clock. */
export function now_s() {
  return performance.now() / 1000;
}

/** The browser's timers, for those parts that a test gives others. */
export const TIMERS = {
  once: (call, wait_s) => setTimeout(call, wait_s * 1000),
  each: (call, period_s) => setInterval(call, period_s * 1000),
  /** timer: of either kind; null and undefined do no harm. */
  cancel: (timer) => clearTimeout(timer),
};

const INITIAL_S = 0.25;
const MAX_S = 2;

/** How long to wait before the next attempt: 0.25 s, doubled up to 2 s. */
export class Backoff {
  #attempts = 0;

  /** The seconds to wait now; each call counts one failure. */
  next_s() {
    const wait_s = Math.min(MAX_S, INITIAL_S * 2 ** this.#attempts);
    this.#attempts = Math.min(this.#attempts + 1, 1000);
    return wait_s;
  }

  reset() {
    this.#attempts = 0;
  }
}
