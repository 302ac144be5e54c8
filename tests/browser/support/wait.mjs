// Waiting for what must come, never for a time.

/** How long anything may take before it counts as never coming. */
export const LIMIT_S = 45;
const LOOK_AGAIN_MS = 20;

/**
 * Wait for a condition and return its value.
 * @param {() => unknown} condition may return a promise; false, null and undefined mean not yet
 * @param {string | (() => string)} what the awaited condition, for the message
 * @param {number} limit_s
 * @returns {Promise<any>} the first other value; rejects when it does not come
 */
export async function until(condition, what, limit_s = LIMIT_S) {
  const end_ms = performance.now() + limit_s * 1000;
  for (;;) {
    const value = await condition();
    if (value !== false && value !== null && value !== undefined) {
      return value;
    }
    if (performance.now() > end_ms) {
      throw new Error(`never came: ${typeof what === "string" ? what : what()}`);
    }
    await new Promise((resolve) => setTimeout(resolve, LOOK_AGAIN_MS));
  }
}
