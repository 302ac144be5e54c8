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

/** Metres between two lines of a grid, 1, 2 or 5 times a power of ten, least_px apart at least. */
export function stepOf(metresPerPixel, least_px = 70) {
  const least_m = metresPerPixel * least_px;
  const power = 10 ** Math.floor(Math.log10(least_m));
  const factor = [1, 2, 5, 10].find((each) => each * power >= least_m * (1 - 1e-9));
  return Number((factor * power).toPrecision(1));
}

/** As `500 mm`, `20 m`, `5 km`. */
export function stepText(step_m) {
  if (step_m < 1) {
    return `${Math.round(step_m * 1000)} mm`;
  }
  return step_m < 1000 ? `${step_m} m` : `${step_m / 1000} km`;
}

/** The lines of a grid that cross a stretch of one axis, in rising metres from the grid's origin. */
export function linesBetween(from_m, to_m, step_m) {
  const lines = [];
  const [least, most] = from_m <= to_m ? [from_m, to_m] : [to_m, from_m];
  for (let each = Math.ceil(least / step_m); each * step_m <= most; each += 1) {
    // -0 would be written as 0, but is not equal to it everywhere.
    lines.push(each * step_m + 0);
  }
  return lines;
}

/** Middle and scale of a picture that shows all points with a margin, and least_m at least. */
export function windowOf(points, size, least_m = 200) {
  const span = (values) => (values.length ? [Math.min(...values), Math.max(...values)] : [0, 0]);
  const [west, east] = span(points.map((each) => each.east_m));
  const [south, north] = span(points.map((each) => each.north_m));
  const margin = 1.25;
  const metresPerPixel = Math.max(
    ((east - west) * margin) / size.width_px,
    ((north - south) * margin) / size.height_px,
    least_m / Math.min(size.width_px, size.height_px),
  );
  return { east_m: (west + east) / 2, north_m: (south + north) / 2, metresPerPixel };
}
