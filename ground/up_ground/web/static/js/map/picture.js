import { bearing_deg, distance_m, distanceText, placeOf } from "./earth.js";
import { ageText, headingText } from "../state/format.js";

/**
 * Content of a map: the name of the aircraft, its last position, home, the track.
 * @typedef {{name: ?string, aircraft: ?{latitude: number, longitude: number}, heading_deg: ?number,
 *   freshness: "live"|"stale"|"none", age: string, home: ?{latitude: number, longitude: number},
 *   track: object}} Picture
 */

/** The last position known, and how fresh it is. */
export function pictureOf(store) {
  const aircraft = placeOf(store.number("location.latitude"), store.number("location.longitude"));
  const last = store.track.points.at(-1);
  const seen = aircraft ?? (last === undefined ? null : placeOf(last[0], last[1]));
  const home = store.status?.home;
  const isSeen = aircraft !== null;
  return {
    name: store.aircraft,
    aircraft: seen,
    heading_deg: isSeen ? headingOf(store) : null,
    freshness: seen === null ? "none" : isSeen ? freshnessOf(store) : "stale",
    age: ageWords(store.age_s("location") ?? store.age_s(null)),
    home: placeOf(home?.latitude, home?.longitude),
    track: store.track,
  };
}

/** Distance and direction to walk. */
export function homeWords(picture) {
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
  return `${distance} from home at ${from}°, the way back ${back}°${age}`;
}

// A position from the track alone: its time is unknown.
function ageWords(age_s) {
  return age_s === null ? "some time" : ageText(age_s);
}

function headingOf(store) {
  return store.freshnessAt("heading.actual") === "live" || store.number("orientation.yaw") === null
    ? store.number("heading.actual")
    : store.number("orientation.yaw");
}

// A position without a known age is as fresh as the frame that brought it.
function freshnessOf(store) {
  return store.freshness("location") === "live" ? "live" : "stale";
}
