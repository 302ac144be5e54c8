import { drawing, setAttribute, setText, short, svg } from "../dom.js";
import { VIEW } from "./horizon.js";
import { Tape } from "./tape.js";
import { freshnessOf, oldText } from "../readout.js";
import { numberText } from "../state/format.js";
import { distance_m } from "../state/earth.js";
import { number } from "../state/validate.js";

const MAX_CLIMB_M_S = 10;
const CLIMB_LENGTH = 96;
const NEAR_HOME_M = 30;

/** Speed on the left, altitude and vertical speed on the right of the horizon. */
export function mount(element, store) {
  const speed = new Tape({
    x: -200,
    width: 56,
    isLeft: true,
    step: 1,
    units: 14,
    each: 5,
    least: 0,
    title: "GS m/s",
    unit: "by fixes",
    key: "motion.ground_speed",
  });
  const altitude = new Tape({
    x: 126,
    width: 58,
    isLeft: false,
    step: 5,
    units: 16,
    each: 4,
    title: "ALT m",
    unit: "sea level",
    key: "altitude",
  });
  const climb = climbOf();
  element.append(
    drawing(
      `${VIEW.x} ${VIEW.y} ${VIEW.width} ${VIEW.height}`,
      "Speed, altitude and vertical speed",
      speed.element,
      altitude.element,
      climb.element,
    ),
  );
  return {
    update() {
      showSpeed(speed, store);
      showAltitude(altitude, store);
      const [climb_m_s, reading] = estimated(store, "navigation.climb", store.motion.climb_m_s, "altitude");
      climb.show(climb_m_s, freshnessOf(store, climb_m_s, reading));
    },
  };
}

/** The aircraft's estimate, or what the page derives; and the reading whose age it has. */
function estimated(store, path, derived, reading) {
  const value = store.number(path);
  return value === null ? [derived, reading] : [value, "navigation"];
}

function showSpeed(tape, store) {
  const [speed_m_s, reading] = estimated(store, "navigation.speed", store.motion.groundSpeed_m_s, "location");
  const freshness = freshnessOf(store, speed_m_s, reading);
  const age = oldText(store, reading, freshness);
  tape.unit = reading === "location" ? "by fixes" : "estimate";
  tape.show(speed_m_s, freshness, numberText(speed_m_s, 1), age);
  const airspeed_m_s = store.number("navigation.airspeed");
  const airspeed = airspeed_m_s === null ? "" : numberText(airspeed_m_s, 1);
  tape.showFoot(airspeed, "airspeed", freshnessOf(store, airspeed_m_s, "navigation"));
}

function showAltitude(tape, store) {
  const altitude_m = store.number("altitude");
  const freshness = freshnessOf(store, altitude_m, "altitude");
  const decimals = altitude_m >= 1000 || altitude_m <= -100 ? 0 : 1;
  const age = oldText(store, "altitude", freshness);
  tape.show(altitude_m, freshness, numberText(altitude_m, decimals), age);
  const [height_m, reading] = estimated(store, "navigation.height", heightOverStart_m(store), "location");
  const where = reading === "navigation" || startsAtHome(store) ? "home" : "start";
  tape.showFoot(height_m === null ? "" : heightText(height_m), `over ${where}`, freshnessOf(store, height_m, reading));
}

function heightText(height_m) {
  return Math.abs(height_m) < 999.5
    ? `${numberText(height_m, 0, { sign: true })} m`
    : `${numberText(height_m / 1000, 1, { sign: true })} km`;
}

/** Above the start of the track, where the aircraft reports no height above home. */
function heightOverStart_m(store) {
  const start_m = store.track.startAltitude_m;
  const here_m = store.number("location.altitude");
  return start_m === null || here_m === null ? null : here_m - start_m;
}

function startsAtHome(store) {
  const start = store.track.points[0];
  const home = store.status?.home;
  const latitude = number(home?.latitude);
  const longitude = number(home?.longitude);
  if (start === undefined || latitude === null || longitude === null) {
    return false;
  }
  const from = { latitude: start[0], longitude: start[1] };
  return distance_m(from, { latitude, longitude }) < NEAR_HOME_M;
}

/** In four figures at most: a glider's tenths count. */
export function climbText(climb_m_s) {
  if (climb_m_s !== null && Math.abs(climb_m_s) >= 99.5) {
    return climb_m_s > 0 ? "99+" : "99-";
  }
  const decimals = Math.abs(climb_m_s) < 9.95 ? 1 : 0;
  return numberText(climb_m_s, decimals);
}

function climbOf() {
  const scale = svg("g", { class: "climb-scale" });
  for (const value of [-10, -5, -2, -1, 0, 1, 2, 5, 10]) {
    const y = -rootScale(value, MAX_CLIMB_M_S, CLIMB_LENGTH);
    scale.append(svg("path", { d: `M185 ${short(y)}h${value === 0 ? 15 : 5}` }));
  }
  const needle = svg("rect", { x: 186, y: 0, width: 12, height: 1, class: "climb-bar" });
  const text = svg("text", { x: 199, y: -113, class: "climb-text", "data-key": "motion.climb" });
  const element = svg(
    "g",
    { class: "climb" },
    svg("rect", { x: 184, y: -140, width: 16, height: 280, class: "tape-ground" }),
    scale,
    needle,
    svg("text", { x: 192, y: -127, class: "climb-title" }, "VS"),
    text,
  );
  return {
    element,
    show(climb_m_s, freshness) {
      const length = climb_m_s === null ? 0 : rootScale(climb_m_s, MAX_CLIMB_M_S, CLIMB_LENGTH);
      setAttribute(element, "data-freshness", freshness);
      setAttribute(needle, "y", short(Math.min(0, -length)));
      setAttribute(needle, "height", short(Math.max(1, Math.abs(length))));
      setAttribute(text, "data-freshness", freshness);
      setText(text, climbText(climb_m_s));
    },
  };
}

/** The needle of a scale that is finer around zero: the root of value / most, within the length. */
export function rootScale(value, most, length) {
  const share = Math.min(1, Math.abs(value) / most);
  return Math.sign(value) * Math.sqrt(share) * length;
}
