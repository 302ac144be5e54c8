import assert from "node:assert/strict";
import { test } from "node:test";

import { History } from "../../../../../ground/up_ground/web/static/js/mission/history.js";
import * as plan from "../../../../../ground/up_ground/web/static/js/mission/plan.js";
import { detailText, totalText } from "../../../../../ground/up_ground/web/static/js/mission/plan_table.js";
import { linesOf } from "../../../../../ground/up_ground/web/static/js/map/plain_map.js";
import { distance_m, placeAt } from "../../../../../ground/up_ground/web/static/js/state/earth.js";

const HOME = { latitude: 50, longitude: 14 };
const at = (east_m, north_m) => placeAt(HOME, { east_m, north_m });
const waypoint = (east_m, north_m, more = {}) => ({ kind: "waypoint", ...at(east_m, north_m), altitude: 80, ...more });
const near = (value, wanted, by) => assert.ok(Math.abs(value - wanted) <= by, `${value} is not ${wanted}`);

test("a jump keeps its target while items are inserted and removed", () => {
  const items = [waypoint(0, 0), waypoint(0, 300), { kind: "jump", item: 2, repeat: 3 }];
  const target = (list) => list.find(({ kind }) => kind === "jump").item;
  assert.equal(target(plan.inserted(items, 0, waypoint(9, 9))), 3);
  assert.equal(target(plan.inserted(items, 1, waypoint(9, 9))), 3);
  assert.equal(target(plan.inserted(items, 2, waypoint(9, 9))), 2);
  assert.equal(target(plan.removed(items, 0)), 1);
  assert.equal(target(plan.removed(items, 1)), 2);
  assert.equal(items[2].item, 2, "the list before is untouched");
});

test("a new item has the height of the item before; one of another kind has the fields of that kind", () => {
  const items = [waypoint(0, 0, { altitude: 410, above_sea: true }), { kind: "land", ...HOME, altitude: 3 }];
  const item = plan.itemAt(items, 2, "loiter_turns", at(100, 0));
  assert.deepEqual([item.altitude, item.above_sea, Object.hasOwn(item, "airspeed")], [410, true, false]);
  assert.equal(plan.itemAt([], 0, "waypoint", HOME).altitude, 80);
  assert.deepEqual(plan.ofKind(item, "return"), { kind: "return" });
  assert.deepEqual(plan.ofKind({ kind: "return" }, "jump"), { kind: "jump", item: 1 });
});

test("one height for all leaves out the ground of a landing", () => {
  const items = [waypoint(0, 0, { altitude: 500, above_sea: true }), { kind: "speed", airspeed: 14 }, { kind: "land", ...HOME, altitude: 3 }];
  const [first, speed, land] = plan.withHeight(items, 60);
  assert.deepEqual([first.altitude, first.above_sea, speed.altitude, land.altitude], [60, undefined, undefined, 3]);
});

test("legs have lengths, directions, and times at the airspeed that holds there", () => {
  const items = [
    { kind: "takeoff", altitude: 50 },
    waypoint(0, 220),
    { kind: "speed", airspeed: 20 },
    waypoint(400, 220),
    { kind: "loiter_turns", ...at(400, 420), altitude: 80, radius: 100, turns: 2 },
    { kind: "loiter_time", ...at(400, 420), altitude: 80, time: 30 },
    { kind: "return" },
  ];
  const legs = plan.legsOf(items, HOME);
  assert.deepEqual(legs.map((leg) => leg === null), [true, false, true, false, false, false, false]);
  near(legs[1].distance_m, 220, 0.5);
  near(legs[1].time_s, 220 / 11, 0.1);
  near(legs[3].time_s, 400 / 20, 0.1);
  near(legs[3].course_deg, 90, 0.1);
  near(legs[4].time_s, (200 + 4 * Math.PI * 100) / 20, 0.2);
  assert.deepEqual([legs[5].distance_m, legs[5].time_s, legs[3].start], [0, 30, 1]);
  near(legs[6].distance_m, Math.hypot(400, 420), 1);
  assert.equal(plan.legsOf(items, null).filter((leg) => leg !== null).length, 3, "without home");
  assert.match(totalText(items, HOME, 300), /^7 items, 1\.40 km, \d:\d\d without wind, at most 80 m above home$/);
});

test("the greatest height counts from home; above sea level it is unknown without home", () => {
  const items = [waypoint(0, 0, { altitude: 450, above_sea: true }), waypoint(0, 100)];
  assert.equal(plan.totalOf(items, HOME, 300).highest_m, 150);
  assert.equal(plan.totalOf(items, HOME, null).highest_m, null);
});

test("corners of an area are moved, inserted and removed; with the last one goes the area", () => {
  const fence = [plan.circleAt(HOME), { corners: [[50, 14]] }];
  const two = plan.withCorner(fence, 1, 1, { latitude: 50.1, longitude: 14 }, true);
  assert.deepEqual(plan.problemsOf(plan.FENCE, two).map(({ item, code }) => [item, code]), [[2, "item_invalid"]]);
  const three = plan.withCorner(two, 1, 1, { latitude: 50.1, longitude: 14.1 }, true);
  assert.deepEqual(three[1].corners, [[50, 14], [50.1, 14.1], [50.1, 14]]);
  assert.deepEqual(plan.problemsOf(plan.FENCE, three), []);
  assert.deepEqual(plan.withCorner(three, 1, 0, HOME)[1].corners[0], [50, 14]);
  assert.equal(plan.withoutCorner(fence, 1, 0).length, 1);
});

test("what the aircraft writes in full equals the drawing", () => {
  const drawn = [waypoint(0, 0), { kind: "return" }];
  const whole = { above_sea: false, over: false, radius: null, clockwise: true, turns: 1, time: 0, item: null, repeat: 1 };
  assert.ok(plan.isSame(plan.listOf(drawn.map((item) => ({ ...whole, ...item }))), drawn));
  assert.ok(!plan.isSame(plan.listOf([{ ...drawn[0], over: true }, drawn[1]]), drawn));
  assert.deepEqual(plan.listOf([null, 3, { kind: "x" }, { corners: [1] }, { kind: "return" }]), [{ kind: "return" }]);
});

test("the plain map has a line for each leg and each border", () => {
  const fence = [{ corners: [[50, 14], [50.1, 14], [50, 14.1]] }, { ...HOME, radius: 300 }];
  const lines = linesOf({ mission: [waypoint(0, 0), waypoint(0, 100), { kind: "return" }], fence }, HOME);
  assert.deepEqual(lines.map(({ name, places, end }) => [name, places.length, end]), [
    ["plan-leg", 2, ""], ["plan-leg", 2, ""], ["plan-border", 3, "Z"], ["plan-border", 48, "Z"],
  ]);
  lines[3].places.forEach((place) => near(distance_m(HOME, place), 300, 1));
});

test("undo and redo go through every state; a new edit ends redo", () => {
  const history = new History(0);
  [1, 2, 3].forEach((each) => history.put(each));
  history.undo();
  history.undo();
  assert.deepEqual([history.present, history.canRedo], [1, true]);
  history.redo();
  assert.equal(history.present, 2);
  history.put(7);
  assert.equal(history.canRedo, false);
  for (let each = 0; each < 9; each += 1) {
    history.undo();
  }
  assert.deepEqual([history.present, history.canUndo], [0, false]);
});

test("details of an item in words", () => {
  assert.equal(detailText({ kind: "loiter_turns", radius: 80, clockwise: false, turns: 2.5 }), "radius 80 m, counter-clockwise, 2.5 turns");
  assert.equal(detailText({ kind: "jump", item: 2, repeat: -1 }), "to 2, without end");
  assert.equal(detailText(waypoint(0, 0)), "");
});
