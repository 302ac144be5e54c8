/** An older frame is shown as stale, before the second is over. */
export const SILENT_S = 0.9;

/** Readings with a period of a second or more become stale later than SILENT_S. */
const STALE_S = { location: 1.9, altitude: 1.9, heading: 1.9, battery: 120 };

/** The readings with ages in telemetry (its `age_ms`). */
export const READINGS = [
  "orientation",
  "rx",
  "servo",
  "flight",
  "location",
  "altitude",
  "heading",
  "battery",
];

const READING_OF = {
  orientation: "orientation",
  rates: "orientation",
  rx: "rx",
  servo: "servo",
  location: "location",
  home: "location",
  altitude: "altitude",
  heading: "heading",
  flight_mode: "flight",
  armed: "flight",
  in_flight: "flight",
  arduino: "flight",
};
/** Values about the Arduino that the Raspberry Pi determines, not the Arduino. */
const KNOWN_TO_PI = new Set(["arduino.connected", "arduino.framing"]);

/**
 * path: of a value in the telemetry. Returns the reading whose age is the value's; null: the
 * frame's own age.
 */
export function readingOf(path) {
  if (path === "android.batteryLevel") {
    return "battery";
  }
  if (KNOWN_TO_PI.has(path)) {
    return null;
  }
  const first = path.split(".", 1)[0];
  return Object.hasOwn(READING_OF, first) ? READING_OF[first] : null;
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
  return age_s > (STALE_S[reading] ?? SILENT_S) ? "stale" : "live";
}
