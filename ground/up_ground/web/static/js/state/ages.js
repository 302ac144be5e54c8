import { READING_OF, READINGS, SILENT_S } from "./schema.js";

/**
 * path: of a value in the telemetry. Returns the reading whose age is the value's; null: the
 * frame's own age.
 */
export function readingOf(path) {
  return Object.hasOwn(READING_OF, path) ? READING_OF[path] : null;
}

/**
 * frameAge_s: age of the newest frame; null: there was none. Returns whether every value on the
 * page may be stale.
 */
export function isSilent(frameAge_s) {
  return frameAge_s === null || frameAge_s > SILENT_S;
}

/**
 * The freshness of a reading, or of the frame itself. reading: null: the frame's own; aboard_ms:
 * its `age_ms`; null: no reading yet; undefined: missing.
 */
export function freshnessOf(reading, frameAge_s, aboard_ms) {
  if (frameAge_s === null || (reading !== null && aboard_ms === null)) {
    return "none";
  }
  if (isSilent(frameAge_s)) {
    return "stale";
  }
  if (reading === null || aboard_ms === undefined) {
    return "live";
  }
  const age_s = frameAge_s + Math.max(0, aboard_ms) / 1000;
  return age_s > (READINGS[reading]?.stale_s ?? SILENT_S) ? "stale" : "live";
}
