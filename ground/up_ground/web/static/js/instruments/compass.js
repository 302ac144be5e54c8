import { drawing, hatch, onCircle, setAttribute, setText, short, svg } from "../dom.js";
import { clockText } from "../panels/messages.js";
import { freshnessOf, oldText } from "../readout.js";
import { distanceText } from "../state/earth.js";
import { headingText, UNKNOWN } from "../state/format.js";

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
  const name = svg("text", { x: 106, y: -84, class: "compass-name is-right" });
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
      name,
    ),
  );
  return {
    update() {
      const actual = store.number("heading.actual");
      const freshness = freshnessOf(store, actual, "heading");
      setAttribute(element, "data-freshness", freshness);
      setAttribute(heading, "data-freshness", freshness);
      setText(age, oldText(store, "heading", freshness));
      setText(heading, actual === null ? UNKNOWN : `${headingText(actual)}°`);
      setAttribute(turning, "transform", `rotate(${short(-(actual ?? 0))})`);
      const bearing_deg = store.number("home.bearing");
      setAttribute(home, "data-freshness", freshnessOf(store, bearing_deg, "location"));
      if (bearing_deg !== null) {
        setAttribute(home, "transform", `rotate(${short(bearing_deg)})`);
      }
      const away_m = store.number("home.distance");
      setText(distance, away_m === null ? UNKNOWN : distanceText(away_m));
      setAttribute(distance, "data-freshness", freshnessOf(store, away_m, "location"));
      const time_s = store.number("home.time_s");
      setText(name, time_s === null ? "home" : `home in ${clockText(time_s)}`);
      setAttribute(name, "data-freshness", time_s === null ? "live" : store.freshness(null));
    },
  };
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
