import { bearing_deg, distance_m, placeAt, placeOf } from "../state/earth.js";

/**
 * Missions and fences as they travel (docs/mission.md), and their edits, which return new lists.
 *
 * @typedef {{kind: string, latitude?: number, longitude?: number, altitude?: number}} Item
 * @typedef {{inside?: boolean, corners?: number[][], latitude?: number, longitude?: number, radius?: number}} Border
 * @typedef {{latitude: number, longitude: number}} Place
 */
export const MISSION = "mission";
export const FENCE = "fence";
export const PLANS = [MISSION, FENCE];
const MIN_CORNERS = 3;
const PLACE = ["latitude", "longitude", "altitude", "above_sea"];
const CIRCLE = [...PLACE, "radius", "clockwise"];
/** The fields of each kind of item, as up/mission/items.py has them. */
export const KINDS = {
  takeoff: ["altitude", "above_sea"],
  waypoint: [...PLACE, "over"],
  loiter: CIRCLE,
  loiter_turns: [...CIRCLE, "turns"],
  loiter_time: [...CIRCLE, "time"],
  return: [],
  land: PLACE,
  speed: ["airspeed"],
  jump: ["item", "repeat"],
};
const DEFAULTS = { above_sea: false, over: false, clockwise: true, turns: 1, time: 0, repeat: 1, inside: true };
const NEW_HEIGHT_M = 80;
const NEW_RADIUS_M = 200;
/** The defaults of navigation.yml and of LOITER. */
export const CRUISE_M_S = 11;
const LOITER_RADIUS_M = 50;
const NEW_FIELDS = { altitude: NEW_HEIGHT_M, airspeed: CRUISE_M_S, item: 1 };
const REQUIRED = new Set(Object.keys(NEW_FIELDS));

/** Every place of a mission and a fence. */
export function placesOf({ mission, fence }) {
  const corners = fence.flatMap((border) => border.corners ?? []).map(([latitude, longitude]) => placeOf(latitude, longitude));
  return [...[...mission, ...fence].map(placeOfItem), ...corners].filter((place) => place !== null);
}

/** Whether items of a kind are at a place. */
export function isPlaced(kind) {
  return KINDS[kind]?.includes("latitude") ?? true;
}

/** The place of an item or a circle; null: it has none. */
export function placeOfItem(item) {
  return placeOf(item?.latitude, item?.longitude);
}

/** A place, rounded to a centimetre. */
function kept({ latitude, longitude }) {
  return { latitude: Number(latitude.toFixed(7)), longitude: Number(longitude.toFixed(7)) };
}

/** A new item of a kind at a place, as high as the item before; index: where it is to be inserted. */
export function itemAt(items, index, kind, place) {
  const before = items.slice(0, index).findLast(({ altitude, kind }) => kind !== "land" && altitude !== undefined);
  const height = { altitude: before?.altitude ?? NEW_HEIGHT_M, above_sea: before?.above_sea };
  const has = { ...NEW_FIELDS, ...(place === null ? {} : kept(place)), ...height };
  return ofKind(has, kind);
}

/** An item as one of another kind: what that kind has no use for is left out. */
export function ofKind(item, kind) {
  const all = { ...NEW_FIELDS, ...item };
  const fields = KINDS[kind].filter((key) => Object.hasOwn(item, key) || REQUIRED.has(key));
  return cleaned({ kind, ...Object.fromEntries(fields.map((key) => [key, all[key]])) });
}

export function circleAt(place) {
  return { ...kept(place), radius: NEW_RADIUS_M };
}

export function cornerAt(place) {
  const { latitude, longitude } = kept(place);
  return [latitude, longitude];
}

/** Put an item before that at an index; jumps keep their targets. */
export function inserted(list, index, item) {
  const moved = list.map((each) => jumping(each, (target) => (target > index ? target + 1 : target)));
  return [...moved.slice(0, index), item, ...moved.slice(index)];
}

/** A jump to the removed item goes to the next one, or to the last. */
export function removed(list, index) {
  const target = (number) => Math.max(1, Math.min(number > index + 1 ? number - 1 : number, list.length - 1));
  return list.filter((_, each) => each !== index).map((each) => jumping(each, target));
}

/** fields: set; undefined and null ones are removed. */
export function changed(list, index, fields) {
  return list.map((each, at) => (at === index ? cleaned({ ...each, ...fields }) : each));
}

export function moved(list, index, place) {
  return changed(list, index, kept(place));
}

/** Every height above home, but that of a landing: the ground there. */
export function withHeight(items, altitude) {
  return items.map((each) =>
    each.altitude === undefined || each.kind === "land" ? each : cleaned({ ...each, altitude, above_sea: undefined }),
  );
}

/** corner: its index among the corners; isNew: put before it, otherwise it is moved there. */
export function withCorner(fence, index, corner, place, isNew = false) {
  const corners = [...fence[index].corners];
  corners.splice(corner, isNew ? 0 : 1, cornerAt(place));
  return changed(fence, index, { corners });
}

/** A border without its last corner is removed. */
export function withoutCorner(fence, index, corner) {
  const corners = fence[index].corners.filter((_, each) => each !== corner);
  return corners.length === 0 ? removed(fence, index) : changed(fence, index, { corners });
}

function jumping(item, target) {
  return item.kind === "jump" && Number.isInteger(item.item) ? { ...item, item: target(item.item) } : item;
}

// The aircraft writes every field, and one with its default as well.
function cleaned(fields) {
  const isGiven = ([key, value]) => value !== undefined && value !== null && DEFAULTS[key] !== value;
  return Object.fromEntries(Object.entries(fields).filter(isGiven));
}

/** A list as a server or an earlier page wrote it; anything but items and borders is dropped. */
export function listOf(found) {
  const all = Array.isArray(found) ? found : [];
  const isArea = (corners) => Array.isArray(corners) && corners.every(Array.isArray);
  const isKnown = (each) => Object.hasOwn(KINDS, each.kind) || isArea(each.corners) || each.radius > 0;
  return all.filter((each) => each !== null && typeof each === "object" && isKnown(each)).map(cleaned);
}

/** Places around a circle, for a map that has only lines. */
export function around(circle) {
  const angles = Array.from({ length: 48 }, (_, index) => (index * Math.PI) / 24);
  const offset = (angle) => ({ east_m: circle.radius * Math.sin(angle), north_m: circle.radius * Math.cos(angle) });
  return angles.map((angle) => placeAt(circle, offset(angle)));
}

/** Where the edge of a circle is drawn and dragged: east of its middle. */
export function edgeOf(circle) {
  return placeAt(circle, { east_m: circle.radius, north_m: 0 });
}

/**
 * The leg to each item: {from, to, distance_m, time_s, course_deg}; null: no leg is known. from and
 * to are places; without wind; a circle's time is part of its leg; `start`: the number of the item
 * where it begins, -1: home.
 */
export function legsOf(items, home = null) {
  let from = null;
  let start = -1;
  let airspeed_m_s = CRUISE_M_S;
  return items.map((item, index) => {
    if (item.kind === "speed") {
      airspeed_m_s = item.airspeed || airspeed_m_s;
    } else if (item.kind === "takeoff") {
      from ??= home;
    }
    const to = item.kind === "return" ? home : placeOfItem(item);
    if (to === null) {
      return null;
    }
    const leg = from === null ? null : legOf(from, to, start, circled_m(item), item, airspeed_m_s);
    [from, start] = [to, index];
    return leg;
  });
}

function legOf(from, to, start, circle_m, item, airspeed_m_s) {
  const way_m = distance_m(from, to);
  const wait_s = item.kind === "loiter_time" ? (item.time ?? 0) : 0;
  const time_s = (way_m + circle_m) / airspeed_m_s + wait_s;
  return { from, to, start, distance_m: way_m, time_s, course_deg: bearing_deg(from, to) };
}

function circled_m({ kind, radius, turns }) {
  return kind === "loiter_turns" ? 2 * Math.PI * (radius ?? LOITER_RADIUS_M) * (turns ?? 1) : 0;
}

/** The circle that an item flies, m; 0: none. */
export function radiusOf(item) {
  return item.kind.startsWith("loiter") ? (item.radius ?? LOITER_RADIUS_M) : 0;
}

/** {length_m, time_s, highest_m: above home; null: unknown}; each item once. homeAltitude_m: above sea level. */
export function totalOf(items, home = null, homeAltitude_m = null) {
  const legs = legsOf(items, home).filter((each) => each !== null);
  const sum = (key) => legs.reduce((total, each) => total + each[key], 0);
  const high = items.filter(({ altitude, kind }) => altitude !== undefined && kind !== "land");
  const heights = high.map(({ altitude, above_sea }) => (above_sea ? altitude - (homeAltitude_m ?? NaN) : altitude));
  const highest_m = heights.length === 0 ? NaN : Math.max(...heights);
  return { length_m: sum("distance_m"), time_s: sum("time_s"), highest_m: Number.isNaN(highest_m) ? null : highest_m };
}

/** What the page itself knows to be wrong: as the aircraft's problems. */
export function problemsOf(name, list) {
  const isShort = ({ corners }) => name === FENCE && corners !== undefined && corners.length < MIN_CORNERS;
  return list.flatMap((each, index) =>
    isShort(each) ? [{ item: index + 1, code: "item_invalid", text: "an area needs at least 3 corners" }] : [],
  );
}

/** Whether two lists are the same, whatever the order of their fields. */
export function isSame(one, other) {
  const text = (list) => JSON.stringify(list.map((each) => Object.entries(each).sort(([a], [b]) => (a < b ? -1 : 1))));
  return text(one) === text(other);
}
