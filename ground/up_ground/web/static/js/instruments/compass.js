import { drawing, hatch, setAttribute, setText, short, svg } from "../dom.js";
import { onCircle } from "./geometry.js";
import { oldText } from "../readout.js";
import { headingText, numberText, UNKNOWN } from "../state/format.js";

const RADIUS = 84;
const LETTERS = { 0: "N", 90: "E", 180: "S", 270: "W" };

/** The rose, north where it is: heading above, the way home on it. */
export function mount(element, store) {
  const rose = roseOf();
  const home = homeOf();
  const heading = svg("text", {
    x: 0,
    y: -98,
    class: "compass-heading",
    "data-key": "heading.actual",
  });
  const distance = svg("text", {
    x: 106,
    y: -98,
    class: "compass-side is-right",
    "data-key": "home.distance",
  });
  const age = svg("text", { x: 0, y: 42, class: "compass-age" });
  const turning = svg("g", {}, rose, home);
  element.append(
    drawing(
      "-108 -114 216 206",
      "Compass",
      svg("circle", { cx: 0, cy: 0, r: RADIUS, class: "rose-ground" }),
      turning,
      svg("path", { d: "M0 -78 L-5 -90 L5 -90 Z", class: "lubber" }),
      svg("path", { d: "M0 -20V22M-19 3H19M-8 19H8", class: "compass-aircraft" }),
      hatch("compass-hatch", { x: -88, y: -88, width: 176, height: 176 }),
      age,
      heading,
      distance,
      svg("text", { x: 106, y: -84, class: "compass-name is-right" }, "home"),
    ),
  );
  return {
    update() {
      const actual = store.number("heading.actual");
      const freshness = freshnessOf(store, "heading.actual", "heading");
      setAttribute(element, "data-freshness", freshness);
      setAttribute(heading, "data-freshness", freshness);
      setText(age, oldText(store, "heading", freshness));
      setText(heading, actual === null ? UNKNOWN : `${headingText(actual)}°`);
      setAttribute(turning, "transform", `rotate(${short(-(actual ?? 0))})`);
      showMark(store, home, "home.bearing", "location");
      const away_m = store.number("home.distance");
      showSide(distance, distanceText(away_m), freshnessOf(store, "home.distance", "location"));
    },
  };
}

export function distanceText(distance_m) {
  if (distance_m === null) {
    return UNKNOWN;
  }
  return distance_m < 9999.5
    ? `${numberText(distance_m)} m`
    : `${numberText(distance_m / 1000, 1)} km`;
}

function freshnessOf(store, path, reading) {
  return store.number(path) === null ? "none" : store.freshness(reading);
}

function showMark(store, mark, path, reading) {
  const bearing = store.number(path);
  setAttribute(mark, "data-freshness", freshnessOf(store, path, reading));
  if (bearing !== null) {
    setAttribute(mark, "transform", `rotate(${short(bearing)})`);
  }
}

function showSide(element, text, freshness) {
  setText(element, text);
  setAttribute(element, "data-freshness", freshness);
}

function homeOf() {
  return svg(
    "g",
    { class: "home" },
    svg("path", { d: "M0 -36V-26", class: "home-way" }),
    svg("path", { d: "M-7 -37V-46L0 -53L7 -46V-37Z", class: "home-mark" }),
  );
}

function roseOf() {
  const rose = svg("g", { class: "rose", "aria-hidden": "true" });
  for (let bearing = 0; bearing < 360; bearing += 5) {
    const length = bearing % 30 === 0 ? 11 : bearing % 10 === 0 ? 8 : 4;
    const from = onCircle(bearing, RADIUS).map(short);
    const to = onCircle(bearing, RADIUS - length).map(short);
    rose.append(svg("path", { d: `M${from}L${to}` }));
    if (bearing % 30 === 0) {
      const letter = LETTERS[bearing];
      const name = letter ?? String(bearing / 10);
      const kind = letter === undefined ? "rose-number" : "rose-letter";
      const transform = `rotate(${bearing})`;
      rose.append(svg("text", { x: 0, y: -59, transform, class: kind }, name));
    }
  }
  return rose;
}
