import { around } from "../mission/plan.js";

/** Circles of the map: what it draws around or at a place, in metres or pixels. */
const CIRCLES = {
  fence: ({ home, fenceRadius_m }) => ({ place: home, radius_m: fenceRadius_m }),
  uncertainty: ({ aircraft, uncertainty_m }) => ({ place: aircraft, radius_m: uncertainty_m }),
  target: ({ target, radius_m }) => ({ place: target, radius_m }),
};
const DOTS = {
  fix: ({ fix }) => ({ place: fix, radius_px: 4 }),
  "target-point": ({ target }) => ({ place: target, radius_px: 5 }),
  chosen: ({ chosen }) => ({ place: chosen, radius_px: 7 }),
};
const MIN_RADIUS_M = 0.1;

/** The circles of a picture: [{name, place, radius_m or radius_px}]; those without a place are missing. */
export function circlesOf(picture) {
  const circles = Object.entries(CIRCLES).map(([name, of]) => ({ name, ...of(picture) }));
  const dots = Object.entries(DOTS).map(([name, of]) => ({ name, ...of(picture) }));
  return [
    ...circles.filter(({ place, radius_m }) => place && radius_m >= MIN_RADIUS_M),
    ...dots.filter(({ place }) => place),
  ];
}

/** Places of the limit around home; none where it is not known. */
export function limitOf({ home, fenceRadius_m: radius }) {
  return home && radius ? around({ ...home, radius }) : [];
}

/** The circles on Leaflet's map. */
export class Overlay {
  #L;
  #map;
  #shown = new Map();

  constructor(L, map) {
    this.#L = L;
    this.#map = map;
  }

  show(picture) {
    const circles = circlesOf(picture);
    const names = new Set(circles.map(({ name }) => name));
    for (const [name, shown] of this.#shown) {
      if (!names.has(name)) {
        shown.remove();
        this.#shown.delete(name);
      }
    }
    for (const { name, place, radius_m, radius_px } of circles) {
      const at = [place.latitude, place.longitude];
      if (!this.#shown.has(name)) {
        const options = { className: `map-${name}`, interactive: false, radius: radius_m ?? radius_px };
        const shown = radius_px === undefined ? this.#L.circle(at, options) : this.#L.circleMarker(at, options);
        this.#shown.set(name, shown.addTo(this.#map));
      }
      this.#shown.get(name).setLatLng(at).setRadius(radius_m ?? radius_px);
    }
  }
}
