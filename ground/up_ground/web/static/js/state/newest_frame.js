import { READING_OF, READINGS, SILENT_S } from "./schema.js";
import * as validate from "./validate.js";

/** The newest telemetry of an aircraft, validated, and the age of each part of it. */
export class NewestFrame {
  #clock_s;
  #frameAt_s = null;
  #frameAge_s = 0;
  #heldAt_s = null;

  /** The tree as received, not validated. */
  data = {};
  frames = 0;
  beacon = null;
  /** Its time in a recorded flight, seconds; null: live. */
  frameTime_s = null;

  /** clock_s: seconds that never jump. */
  constructor(clock_s) {
    this.#clock_s = clock_s;
  }

  /**
   * message: the server's `frame`; way_s: how long it was on its way from the server. Returns
   * whether it was one.
   */
  updateFrame(message, way_s) {
    if (message.data === null || typeof message.data !== "object") {
      return false;
    }
    this.data = message.data;
    this.beacon = validate.number(message.beacon);
    this.frameTime_s = validate.number(message.time_s);
    this.frames += 1;
    this.#frameAt_s = this.now_s;
    this.#heldAt_s = this.#heldAt_s === null ? null : this.now_s;
    this.#frameAge_s = Math.max(0, validate.number(message.age_ms) ?? 0) / 1000 + way_s;
    return true;
  }

  /** Freeze all ages: the flight stands still, as in a paused replay. */
  hold() {
    this.#heldAt_s ??= this.now_s;
  }

  /** Resume the ages from their frozen values. */
  release() {
    if (this.#heldAt_s !== null && this.#frameAt_s !== null) {
      this.#frameAt_s += this.now_s - this.#heldAt_s;
    }
    this.#heldAt_s = null;
  }

  clearFrame() {
    this.data = {};
    this.beacon = null;
    this.#frameAt_s = null;
  }

  /** The clock of all ages, seconds. */
  get now_s() {
    return this.#clock_s();
  }

  get isSilent() {
    return isSilent(this.age_s(null));
  }

  get aircraftState() {
    return this.#frameAt_s === null ? "none" : this.isSilent ? "silent" : "live";
  }

  number(path) {
    return validate.number(validate.at(this.data, path));
  }

  flag(path) {
    return validate.flag(validate.at(this.data, path));
  }

  text(path) {
    return validate.text(validate.at(this.data, path));
  }

  texts(path) {
    return validate.texts(validate.at(this.data, path));
  }

  value(path) {
    return this.number(path) ?? this.flag(path) ?? this.text(path) ?? this.texts(path);
  }

  /**
   * reading: of `age_ms`; null: the newest frame itself. Returns seconds: on board, on the links,
   * and since; null: unknown.
   */
  age_s(reading) {
    if (this.#frameAt_s === null) {
      return null;
    }
    const frame_s = this.#frameAge_s + (this.#heldAt_s ?? this.now_s) - this.#frameAt_s;
    if (reading === null || reading === undefined) {
      return frame_s;
    }
    const aboard_ms = this.number(`age_ms.${reading}`);
    return aboard_ms === null ? null : frame_s + Math.max(0, aboard_ms) / 1000;
  }

  /** reading: null: the newest frame itself. */
  freshness(reading) {
    const aboard = validate.at(this.data, `age_ms.${reading}`);
    return freshnessOf(
      reading,
      this.age_s(null),
      aboard === null ? null : (validate.number(aboard) ?? undefined),
    );
  }

  freshnessAt(path) {
    return this.value(path) === null ? "none" : this.freshness(readingOf(path));
  }
}

/** What the page calls an `aircraftState`. */
export const STATE_WORDS = { live: "live", silent: "silent", none: "waiting" };

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
