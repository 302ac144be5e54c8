import { setAttribute, setText, svg } from "../dom.js";
import { circlesOf, limitOf } from "./overlay.js";
import { AircraftSymbol } from "./picture.js";
import { piecesOf } from "./track_line.js";
import { around, legsOf } from "../mission/plan.js";
import { linesBetween, offsetOf, placeAt, stepOf, stepText, windowOf } from "../state/earth.js";

const MAX_POINTS = 1500;
/** Height covered by the line of text below the map. */
const FOOT_PX = 40;

/** A map of our own: track, home and aircraft in metres on a grid. It always shows everything. */
export class PlainMap {
  #symbol = new AircraftSymbol();
  #lines = svg("path.grid");
  #track = svg("path.track");
  #home = svg("path.home-symbol");
  #scale = svg("text.scale", { x: 12 });
  #step_m = 0;
  #place;
  #circles = svg("g");
  #plans = svg("g");
  #placeAtPixel = () => null;

  isFollowing = false;

  /** onChoose: a place was clicked. */
  constructor(place, onChoose) {
    this.#place = place;
    place.tabIndex = 0;
    place.addEventListener("click", ({ clientX, clientY }) => {
      const { left, top } = place.getBoundingClientRect();
      onChoose(this.#placeAtPixel(clientX - left, clientY - top));
    });
    this.element = svg(
      "svg.plain-map",
      { role: "img", "aria-label": "Map: track, home and aircraft on a grid of metres" },
      this.#lines,
      this.#plans,
      this.#track,
      this.#home,
      this.#circles,
      this.#symbol.element,
      this.#scale,
    );
    place.append(this.element);
  }

  /** The place in the middle; null: nothing is shown yet. */
  get middle() {
    return this.#placeAtPixel(this.#place.clientWidth / 2, this.#place.clientHeight / 2);
  }

  show(picture) {
    const { aircraft, heading_deg, freshness, age, home, track, plans } = picture;
    const origin = home ?? aircraft;
    const size = { width_px: this.#place.clientWidth, height_px: this.#place.clientHeight };
    if (origin === null || size.width_px === 0 || size.height_px === 0) {
      return;
    }
    const every = Math.ceil(track.points.length / MAX_POINTS) || 1;
    const pieces = piecesOf(track.points).map((piece) =>
      piece
        .filter((_, index) => index % every === 0 || index === piece.length - 1)
        .map(([latitude, longitude]) => offsetOf(origin, { latitude, longitude })),
    );
    const craft = aircraft === null ? null : offsetOf(origin, aircraft);
    const shown = craft === null ? pieces.flat() : [...pieces.flat(), craft];
    const limit = limitOf(picture).map((each) => offsetOf(origin, each));
    const lines = linesOf(plans, home).map((line) => ({ ...line, at: line.places.map((each) => offsetOf(origin, each)) }));
    const view = windowOf([...shown, ...limit, ...lines.flatMap(({ at }) => at), { east_m: 0, north_m: 0 }], size);
    const x = (each) => size.width_px / 2 + (each.east_m - view.east_m) / view.metresPerPixel;
    const y = (each) => size.height_px / 2 - (each.north_m - view.north_m) / view.metresPerPixel;
    this.#placeAtPixel = (x_px, y_px) =>
      placeAt(origin, {
        east_m: view.east_m + (x_px - size.width_px / 2) * view.metresPerPixel,
        north_m: view.north_m - (y_px - size.height_px / 2) * view.metresPerPixel,
      });
    const circles = circlesOf(picture).map(({ name, place, radius_m, radius_px }) => {
      const at = offsetOf(origin, place);
      return svg(`circle.map-${name}`, { cx: x(at), cy: y(at), r: radius_px ?? radius_m / view.metresPerPixel });
    });
    this.#circles.replaceChildren(...circles);
    setAttribute(this.element, "viewBox", `0 0 ${size.width_px} ${size.height_px}`);
    this.#drawGrid(view, size, x, y);
    const point = (each) => `${x(each).toFixed(1)} ${y(each).toFixed(1)}`;
    this.#plans.replaceChildren(...lines.map(({ name, at, end }) => svg(`path.${name}`, { d: `M${at.map(point).join("L")}${end}` })));
    setAttribute(this.#track, "d", pieces.map((piece) => `M${piece.map(point).join("L")}`).join(""));
    const at = { east_m: 0, north_m: 0 };
    const isHome = home !== null;
    setAttribute(this.#home, "d", isHome ? `M${x(at)} ${y(at) - 9} l9 9 h-3 v8 h-12 v-8 h-3 Z` : "");
    setAttribute(this.#symbol.element, "visibility", craft === null ? "hidden" : "visible");
    if (craft !== null) {
      this.#symbol.show(heading_deg, freshness, age);
      setAttribute(this.#symbol.element, "x", (x(craft) - 20).toFixed(1));
      setAttribute(this.#symbol.element, "y", (y(craft) - 20).toFixed(1));
    }
  }

  /** Does nothing: this map always shows everything. */
  follow() {}

  zoom() {}

  showAll() {}

  #drawGrid(view, size, x, y) {
    this.#step_m = stepOf(view.metresPerPixel);
    const half = { east: (size.width_px / 2) * view.metresPerPixel, north: (size.height_px / 2) * view.metresPerPixel };
    const across = linesBetween(view.east_m - half.east, view.east_m + half.east, this.#step_m);
    const up = linesBetween(view.north_m - half.north, view.north_m + half.north, this.#step_m);
    const path = [
      ...across.map((east_m) => `M${x({ east_m }).toFixed(1)} 0V${size.height_px}`),
      ...up.map((north_m) => `M0 ${y({ north_m }).toFixed(1)}H${size.width_px}`),
    ];
    setAttribute(this.#lines, "d", path.join(""));
    setAttribute(this.#scale, "y", size.height_px - FOOT_PX);
    setText(this.#scale, `a square is ${stepText(this.#step_m)} wide, north is up`);
  }
}

/** The mission's legs and the fence's borders: {name, places, end: closes the line}. */
export function linesOf({ mission, fence }, home) {
  const legs = legsOf(mission, home).filter((leg) => leg !== null);
  const placesOf = ({ corners }) => corners.map(([latitude, longitude]) => ({ latitude, longitude }));
  const borders = fence.map((border) => (border.corners ? placesOf(border) : around(border)));
  return [
    ...legs.map(({ from, to }) => ({ name: "plan-leg", places: [from, to], end: "" })),
    ...borders.map((places) => ({ name: "plan-border", places, end: "Z" })),
  ];
}
