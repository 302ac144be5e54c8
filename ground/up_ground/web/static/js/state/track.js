import { number } from "./judge.js";

const MOST = 20000;
const STEP_DEG = 0.00001;

/** Where the aircraft flew: [latitude, longitude, altitude|null] each, the oldest first. */
export class Track {
  /** @type {[number, number, number|null][]} */
  points = [];
  /** Counts the times it was replaced or emptied; points appended do not change it. */
  version = 0;
  /** The altitude where it begins, m; null while none is known. */
  startAltitude_m = null;

  /** @param {unknown} points the server's, taken in place of what was here */
  replace(points) {
    this.points = (Array.isArray(points) ? points : [])
      .map(pointOf)
      .filter((each) => each !== null);
    this.startAltitude_m = this.points.find((each) => each[2] !== null)?.[2] ?? null;
    this.version += 1;
  }

  /**
   * @param {number|null} latitude
   * @param {number|null} longitude
   * @param {number|null} altitude
   */
  append(latitude, longitude, altitude) {
    const point = pointOf([latitude, longitude, altitude]);
    const last = this.points.at(-1);
    if (point === null || (last !== undefined && isNear(last, point))) {
      return;
    }
    this.points.push(point);
    this.startAltitude_m ??= point[2];
    if (this.points.length > MOST) {
      this.points.splice(0, MOST / 10);
      this.version += 1;
    }
  }
}

function pointOf(each) {
  if (!Array.isArray(each)) {
    return null;
  }
  const [latitude, longitude, altitude] = each.map(number);
  if (latitude === null || longitude === null) {
    return null;
  }
  if (Math.abs(latitude ?? 91) > 90 || Math.abs(longitude ?? 181) > 180) {
    return null;
  }
  return [latitude, longitude, altitude ?? null];
}

function isNear(one, other) {
  return Math.abs(one[0] - other[0]) < STEP_DEG && Math.abs(one[1] - other[1]) < STEP_DEG;
}
