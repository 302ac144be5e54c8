/**
 * The distance between two lines of a grid: 1, 2 or 5 times a power of ten. least_px: how close two
 * lines may be. Returns metres.
 */
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

/**
 * The lines of a grid that cross a stretch of one axis. Returns metres from the grid's origin,
 * rising.
 */
export function linesBetween(from_m, to_m, step_m) {
  const lines = [];
  const [least, most] = from_m <= to_m ? [from_m, to_m] : [to_m, from_m];
  for (let each = Math.ceil(least / step_m); each * step_m <= most; each += 1) {
    // -0 would be written as 0, but is not equal to it everywhere.
    lines.push(each * step_m + 0);
  }
  return lines;
}

/**
 * The part of the plane in the picture, so that all points lie in it with a margin. least_m: the
 * least that is shown across. Returns its middle and scale.
 */
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
