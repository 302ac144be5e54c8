/**
 * The clock of every age: seconds that never jump with the wall clock. Returns seconds since the
 * page began.
 */
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
