/** How many of the newest points are drawn bright, and then fainter. */
const PARTS = [
  { upTo: 150, opacity: 1, weight: 3 },
  { upTo: 600, opacity: 0.6, weight: 2 },
  { upTo: Infinity, opacity: 0.35, weight: 2 },
];

/** Number of new points after which the old parts are redrawn. */
const AGAIN = 50;

/** The track on Leaflet's map, the older the fainter. */
export class TrackLine {
  #lines;
  #casings;
  #version = -1;
  #count = 0;
  #drawnCount = 0;
  #points = [];

  /** L: Leaflet; isCased: whether a wider line lies below: on pictures of the ground. */
  constructor(L, map, isCased) {
    const renderer = L.svg({ padding: 0.3 });
    const lineOf = (className, opacity, weight) =>
      L.polyline([], { className, opacity, weight, interactive: false, renderer }).addTo(map);
    this.#casings = PARTS.map(({ weight }) => (isCased ? lineOf("track-case", 0.7, weight + 3) : null));
    this.#lines = PARTS.map(({ opacity, weight }) => lineOf("track", opacity, weight));
  }

  show({ points, version }) {
    if (version === this.#version && points.length === this.#count) {
      return;
    }
    const isOther = version !== this.#version;
    this.#points = points;
    this.#version = version;
    this.#count = points.length;
    const isDue = isOther || points.length - this.#drawnCount >= AGAIN;
    if (isDue) {
      this.#drawnCount = points.length;
    }
    // Between two drawings of the whole only the newest part grows.
    const grown = points.length - this.#drawnCount;
    let end = points.length;
    this.#lines.forEach((line, index) => {
      const upTo = PARTS[index].upTo + grown;
      const begin = Math.max(0, Number.isFinite(upTo) ? points.length - upTo : 0);
      if (index === 0 || isDue) {
        const part = points.slice(begin, end + (index === 0 ? 0 : 1));
        const pieces = piecesOf(part);
        line.setLatLngs(pieces);
        this.#casings[index]?.setLatLngs(pieces);
      }
      end = begin;
    });
  }

  /** Leaflet's bounds of the whole track; null: no point yet. */
  bounds() {
    if (this.#points.length === 0) {
      return null;
    }
    const bounds = this.#lines[0].getBounds();
    this.#points.forEach(([latitude, longitude]) => bounds.extend([latitude, longitude]));
    return bounds;
  }
}

/** The latitudes and longitudes of a track in pieces: no line crosses a silence. */
export function piecesOf(points) {
  const pieces = [];
  for (const point of points) {
    if (pieces.length === 0 || point[3] === true) {
      pieces.push([]);
    }
    pieces.at(-1).push([point[0], point[1]]);
  }
  return pieces;
}
