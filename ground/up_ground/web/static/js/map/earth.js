const RADIUS_M = 6371008.8;
const RADIANS = Math.PI / 180;

/**
 * @typedef {{latitude: number, longitude: number}} Place in degrees
 * @typedef {{east_m: number, north_m: number}} Offset
 */

/** Null: no place on Earth. */
export function placeOf(latitude, longitude) {
  const isPlace =
    typeof latitude === "number" &&
    typeof longitude === "number" &&
    Math.abs(latitude) <= 90 &&
    Math.abs(longitude) <= 180;
  return isPlace ? { latitude, longitude } : null;
}

/** Metres along the great circle. */
export function distance_m(from, to) {
  const half = (degrees) => Math.sin((degrees * RADIANS) / 2) ** 2;
  const chord =
    half(to.latitude - from.latitude) +
    Math.cos(from.latitude * RADIANS) *
      Math.cos(to.latitude * RADIANS) *
      half(to.longitude - from.longitude);
  return 2 * RADIUS_M * Math.asin(Math.min(1, Math.sqrt(chord)));
}

/** Degrees clockwise from north, 0 to 360, at `from`. */
export function bearing_deg(from, to) {
  const turn = (to.longitude - from.longitude) * RADIANS;
  const [there, here] = [to.latitude * RADIANS, from.latitude * RADIANS];
  const east = Math.sin(turn) * Math.cos(there);
  const north =
    Math.cos(here) * Math.sin(there) - Math.sin(here) * Math.cos(there) * Math.cos(turn);
  return (Math.atan2(east, north) / RADIANS + 360) % 360;
}

/** Metres on the plane that touches the Earth at a place: true enough for as far as one can see. */
export function offsetOf(origin, place) {
  const turn = ((place.longitude - origin.longitude + 540) % 360) - 180;
  return {
    east_m: turn * RADIANS * RADIUS_M * Math.cos(origin.latitude * RADIANS),
    north_m: (place.latitude - origin.latitude) * RADIANS * RADIUS_M,
  };
}

export function placeAt(origin, { east_m, north_m }) {
  return {
    latitude: origin.latitude + north_m / RADIUS_M / RADIANS,
    longitude:
      origin.longitude + east_m / RADIUS_M / RADIANS / Math.cos(origin.latitude * RADIANS),
  };
}

/** As `7.5 m`, `340 m`, `1.25 km`, `14.2 km`. */
export function distanceText(metres) {
  if (metres < 9.95) {
    return `${metres.toFixed(1)} m`;
  }
  if (metres < 999.5) {
    return `${metres.toFixed(0)} m`;
  }
  return `${(metres / 1000).toFixed(metres < 9995 ? 2 : 1)} km`;
}
