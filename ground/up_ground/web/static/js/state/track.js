import { number } from "./validate.js";

/** Longer gaps interrupt a line; a slow period extends the limit. */
export const GAP_S = 0.9;

/** Number of intervals for the median period; a silence among them does not change it. */
const INTERVALS = 5;

/** Detects a silence from the period of the arrivals. */
export class Silence {
  #last_s = null;
  #intervals_s = [];

  /** Minimum duration of a silence, seconds. */
  get limit_s() {
    const known = this.#intervals_s;
    const period_s = known.length < INTERVALS ? 0 : known.toSorted((a, b) => a - b)[INTERVALS >> 1];
    return Math.max(GAP_S, 2.5 * period_s);
  }

  /** Take an arrival. Returns whether there was a silence before it. */
  take(time_s) {
    const since_s = this.#last_s === null ? 0 : time_s - this.#last_s;
    const wasSilent = since_s > this.limit_s;
    if (this.#last_s !== null) {
      this.#intervals_s = [...this.#intervals_s, since_s].slice(-INTERVALS);
    }
    this.#last_s = time_s;
    return wasSilent;
  }

  /** Forget all arrivals. from_s: a silence counts from then on; null: from the next arrival. */
  clear(from_s = null) {
    this.#last_s = from_s;
    this.#intervals_s = [];
  }
}

const MAX_ITEMS = 20000;
const STEP_DEG = 0.00001;

/** Points [latitude, longitude, altitude|null, true?], the oldest first; true: a gap lies before it. */
export class Track {
  #silence = new Silence();

  /** @type {[number, number, number|null, true?][]} */
  points = [];
  /** Counts the times it was replaced or emptied; points appended do not change it. */
  version = 0;
  startAltitude_m = null;

  /** points: the server's, which replace the present ones; now_s: a silence counts from then on. */
  replace(points, now_s = null) {
    this.#silence.clear(now_s);
    this.points = (Array.isArray(points) ? points : [])
      .map(pointOf)
      .filter((each) => each !== null);
    this.startAltitude_m = this.points.find((each) => each[2] !== null)?.[2] ?? null;
    this.version += 1;
  }

  /** now_s: when it was known to be there. */
  append(latitude, longitude, altitude, now_s) {
    const point = pointOf([latitude, longitude, altitude]);
    if (point === null) {
      return;
    }
    const wasSilent = this.#silence.take(now_s);
    const last = this.points.at(-1);
    if (last !== undefined && isNear(last, point)) {
      return;
    }
    if (wasSilent && last !== undefined) {
      point.push(true);
    }
    this.points.push(point);
    this.startAltitude_m ??= point[2];
    if (this.points.length > MAX_ITEMS) {
      this.points.splice(0, MAX_ITEMS / 10);
      this.version += 1;
    }
  }
}

function pointOf(each) {
  if (!Array.isArray(each)) {
    return null;
  }
  const [latitude, longitude, altitude] = each.slice(0, 3).map(number);
  if (latitude === null || longitude === null) {
    return null;
  }
  if (Math.abs(latitude ?? 91) > 90 || Math.abs(longitude ?? 181) > 180) {
    return null;
  }
  const point = [latitude, longitude, altitude ?? null];
  return each[3] === true ? [...point, true] : point;
}

function isNear(one, other) {
  return Math.abs(one[0] - other[0]) < STEP_DEG && Math.abs(one[1] - other[1]) < STEP_DEG;
}
