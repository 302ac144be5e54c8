import { setAttribute, setText, svg } from "../dom.js";
import { bearing_deg, distance_m, distanceText, placeOf } from "../state/earth.js";
import { ageText, headingText } from "../state/format.js";
import { clockText } from "../panels/messages.js";

/**
 * Content of a map: the name of the aircraft, its estimated or last position, home, the track.
 * fenceRadius_m: of failsafe.yml, around home; uncertainty_m: two standard deviations of the estimate; fix: the receiver's position beside it;
 * plans: as the page draws them; target: what the mode flies to; time_s: of the way home; null: it does not arrive, undefined: unknown.
 * @typedef {{latitude: number, longitude: number}} Place
 * @typedef {{name: ?string, aircraft: ?Place, heading_deg: ?number, uncertainty_m: ?number,
 *   fix: ?Place, target: ?Place, radius_m: ?number, freshness: "live"|"stale"|"none", age: string,
 *   home: ?Place, fenceRadius_m: ?number, time_s: ?number|undefined, track: object,
 *   plans: {mission: object[], fence: object[]}}} Picture
 */

/** Where an aircraft is by its newest frame: its estimate, otherwise the fix; how fresh that is, and its heading. */
export function positionOf(frame) {
  const estimate = placeAt(frame, "navigation");
  const fix = placeAt(frame, "location");
  const aircraft = estimate ?? fix;
  const reading = estimate === null ? "location" : "navigation";
  // The time of a position from the track alone is unknown.
  const age_s = frame.age_s(reading) ?? frame.age_s(null);
  const freshness = aircraft !== null && frame.freshness(reading) === "live" ? "live" : "stale";
  const age = age_s === null ? "some time" : ageText(age_s);
  return { aircraft, estimate, fix, freshness, age, heading_deg: aircraft === null ? null : headingOf(frame) };
}

/** The last position known, and how fresh it is. */
export function pictureOf(store) {
  const { aircraft, estimate, fix, freshness, age, heading_deg } = positionOf(store);
  const last = store.track.points.at(-1);
  const seen = aircraft ?? (last === undefined ? null : placeOf(last[0], last[1]));
  const known = store.status?.home;
  const sd_m = estimate === null ? null : store.number("navigation.sd.position");
  return {
    name: store.aircraft,
    aircraft: seen,
    heading_deg,
    freshness: seen === null ? "none" : freshness,
    age,
    uncertainty_m: sd_m === null ? null : 2 * sd_m,
    fix: estimate === null ? null : fix,
    target: placeAt(store, "navigation.target"),
    radius_m: store.number("navigation.target.radius"),
    fenceRadius_m: store.number("fence.radius"),
    home: placeAt(store, "home") ?? placeOf(known?.latitude, known?.longitude),
    time_s: estimate === null || store.number("home.latitude") === null ? undefined : store.number("home.time_s"),
    track: store.track,
  };
}

function placeAt(store, path) {
  return placeOf(store.number(`${path}.latitude`), store.number(`${path}.longitude`));
}

export function homeText(picture) {
  if (picture.aircraft === null) {
    return "No position yet";
  }
  const age = picture.freshness === "live" ? "" : `, seen ${picture.age} ago`;
  if (picture.home === null) {
    return `No home yet${age}`;
  }
  const distance = distanceText(distance_m(picture.home, picture.aircraft));
  const back = headingText(bearing_deg(picture.aircraft, picture.home));
  const from = headingText(bearing_deg(picture.home, picture.aircraft));
  return `${distance} from home at ${from}°, way back ${back}°${timeText(picture)}${age}`;
}

function timeText({ time_s }) {
  if (time_s === undefined) {
    return "";
  }
  return time_s === null ? ", not reached in this wind" : `, home in ${clockText(time_s)}`;
}

function headingOf(store) {
  const estimated_deg = store.number("navigation.heading");
  if (estimated_deg !== null) {
    return estimated_deg;
  }
  return store.freshnessAt("heading.actual") === "live" || store.number("orientation.yaw") === null
    ? store.number("heading.actual")
    : store.number("orientation.yaw");
}

const OUTLINE = "M0 -15 L2 -9 L2 -4 L15 3 L15 6 L2 3 L1.5 10 L5 13 L5 15 L0 14 L-5 15 L-5 13 L-1.5 10 L-2 3 L-15 6 L-15 3 L-2 -4 L-2 -9 Z";
const NO_HEADING = "M0 -9 A9 9 0 1 1 -0.01 -9 Z";

/** The aircraft as the map draws it: turned by its heading; without one it is a disc. */
export class AircraftSymbol {
  #outline = svg("path", { d: NO_HEADING });
  #age = svg("text", { x: 0, y: 30, "text-anchor": "middle" });

  constructor() {
    this.element = svg(
      "svg.aircraft-symbol",
      { viewBox: "-18 -18 36 36", width: 40, height: 40, "aria-hidden": "true" },
      this.#outline,
      this.#age,
    );
  }

  /** heading_deg: clockwise from north; age: of the position, written below it while it is not live. */
  show(heading_deg, freshness, age) {
    setAttribute(this.#outline, "d", heading_deg === null ? NO_HEADING : OUTLINE);
    setAttribute(this.#outline, "transform", `rotate(${(heading_deg ?? 0).toFixed(1)})`);
    setAttribute(this.element, "data-freshness", freshness);
    setText(this.#age, freshness === "live" ? "" : age);
  }
}
