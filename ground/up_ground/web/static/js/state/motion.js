import { distance_m } from "./earth.js";

const MAX_S = 6;
const MIN_S = 0.4;
const KEPT = 16;
const WINDOW_S = 2.2;
const JITTER_S = 0.05;
const REPEAT_S = 0.3;

/**
 * Ground speed and vertical speed, derived from the positions and altitudes in telemetry, which has
 * neither. Null until the second fix. Times are the flight's: in a replay not those of the page.
 */
export class Motion {
  #places = [];
  #altitudes = [];
  groundSpeed_m_s = null;
  climb_m_s = null;

  /** at_s: when it was measured. */
  place(latitude, longitude, at_s) {
    if (latitude === null || longitude === null || at_s === null) {
      return;
    }
    if (keep(this.#places, { at_s, latitude, longitude }, isSamePlace)) {
      this.groundSpeed_m_s = rate(this.#places, distance_m);
    }
  }

  height(altitude_m, at_s) {
    if (altitude_m === null || at_s === null) {
      return;
    }
    if (keep(this.#altitudes, { at_s, altitude_m }, isSameHeight)) {
      this.climb_m_s = rate(this.#altitudes, (from, to) => to.altitude_m - from.altitude_m);
    }
  }
}

/** Many frames repeat a fix; only a newer one counts, and ages jitter by a few ms. */
function keep(list, fix, isSame) {
  const last = list.at(-1);
  const since_s = last === undefined ? Infinity : fix.at_s - last.at_s;
  if (since_s < JITTER_S || (since_s < REPEAT_S && isSame(last, fix))) {
    return false;
  }
  if (since_s > MAX_S) {
    list.length = 0;
  }
  list.push(fix);
  list.splice(0, Math.max(0, list.length - KEPT));
  return true;
}

function rate(list, difference) {
  const last = list.at(-1);
  const from =
    list.find((each) => last.at_s - each.at_s <= WINDOW_S && each !== last) ?? list.at(-2);
  const time_s = from === undefined ? 0 : last.at_s - from.at_s;
  if (time_s < MIN_S) {
    return null;
  }
  return difference(from, last) / time_s;
}

function isSamePlace(one, other) {
  return one.latitude === other.latitude && one.longitude === other.longitude;
}

function isSameHeight(one, other) {
  return one.altitude_m === other.altitude_m;
}
