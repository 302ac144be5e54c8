/**
 * The clock of every age: seconds that never jump with the wall clock.
 * @returns {number} seconds since the page began
 */
export function now_s() {
  return performance.now() / 1000;
}
