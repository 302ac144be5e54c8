import assert from "node:assert/strict";
import { test } from "node:test";

import { Storage } from "../../../../../ground/up_ground/web/static/js/link/storage.js";
import { Editor } from "../../../../../ground/up_ground/web/static/js/mission/editor.js";
import { FENCE, MISSION } from "../../../../../ground/up_ground/web/static/js/mission/plan.js";
import { limitsText, progressText, usedState } from "../../../../../ground/up_ground/web/static/js/mission/progress.js";
import { NewestFrame } from "../../../../../ground/up_ground/web/static/js/state/newest_frame.js";

const place = (number) => ({ latitude: 50 + number / 1000, longitude: 14 });

function drawn(memory = new Storage(null)) {
  const editor = new Editor(memory);
  [1, 2, 3].forEach((each) => editor.add(place(each)));
  return editor;
}

function telemetry(data) {
  const store = new NewestFrame(() => 0);
  store.updateFrame({ data, age_ms: 0 }, 0);
  return store;
}

test("a click adds at the end; without a place an item follows the selected one", () => {
  const editor = drawn();
  editor.select(0);
  editor.choose("speed");
  editor.addItem();
  assert.deepEqual(editor.list.map(({ kind }) => kind), ["waypoint", "speed", "waypoint", "waypoint"]);
  assert.equal(editor.selected, 1);
  editor.add(place(4));
  assert.deepEqual([editor.list.length, editor.list[4].kind], [5, "waypoint"]);
});

test("clicks draw one area until another is begun", () => {
  const editor = new Editor(new Storage(null));
  editor.show(FENCE);
  [1, 2, 3].forEach((each) => editor.add(place(each)));
  editor.choose("area");
  editor.add(place(4));
  editor.choose("circle");
  editor.add(place(5));
  assert.deepEqual(editor.list.map(({ corners }) => corners?.length), [3, 1, undefined]);
});

test("a reloaded page has the drawing, and knows what the aircraft has of it", () => {
  const kept = new Map();
  const storage = { getItem: (key) => kept.get(key) ?? null, setItem: (key, text) => kept.set(key, text) };
  const before = drawn(new Storage(storage));
  before.setUsed(MISSION, "abc", before.list);
  const after = new Editor(new Storage(storage));
  assert.deepEqual(after.drawn, before.drawn);
  assert.equal(after.isUsed("abc"), true);
  kept.set("up.mission", '{"drawn": {"mission": 7}, "used": [');
  assert.deepEqual(new Editor(new Storage(storage)).drawn, { mission: [], fence: [] });
});

test("an edit makes the drawn mission another than the aircraft's, and undo the same again", () => {
  const editor = drawn();
  const state = (mission) => usedState(editor, telemetry({ mission }), MISSION);
  assert.equal(state({ id: "abc", count: 3 }), "other");
  editor.setUsed(MISSION, "abc", editor.list);
  assert.equal(state({ id: "abc", count: 3 }), "same");
  editor.remove(1);
  assert.equal(state({ id: "abc", count: 3 }), "other");
  editor.undo();
  assert.equal(state({ id: "abc", count: 3 }), "same");
  assert.equal(state({ id: "def", count: 3 }), "other");
  assert.equal(state({ id: "", count: 0 }), "none");
  assert.equal(usedState(new Editor(new Storage()), telemetry({ mission: { id: "abc", count: 3 } }), MISSION), "undrawn");
  assert.equal(usedState(editor, telemetry({}), MISSION), "unknown");
});

test("problems mark the plan that was sent, until it is edited", () => {
  const editor = drawn();
  editor.setProblems(MISSION, [{ item: 2, code: "turn", text: "too short" }]);
  assert.deepEqual(editor.problems.map(({ code }) => code), ["turn"]);
  editor.show(FENCE);
  assert.deepEqual(editor.problems, []);
  editor.show(MISSION);
  editor.remove(0);
  assert.deepEqual(editor.problems, []);
});

test("the limits that are set, in words", () => {
  assert.match(limitsText(telemetry({ fence: { count: 1, radius: 350, floor: -5 } })), /: radius 350 m, floor -5 m\.$/);
  assert.equal(limitsText(telemetry({ fence: { count: 1 } })), "");
});

test("progress in words", () => {
  const text = (mission, mode = "MISSION") =>
    progressText(telemetry({ mission, flight_mode: "SETPOINT", flight_control: { mode } }));
  const third = { count: 12, item: 3, distance: 339.6, is_finished: false };
  assert.equal(text(third), "Item 3 of 12, 340 m ahead.");
  assert.equal(text(third, "LOITER"), "Item 3 of 12 is next, 340 m away.");
  assert.equal(text(third, "RETURN"), "Returning; item 3 of 12 is next.");
  assert.equal(text({ ...third, item: 12 }, "LAND"), "Landing: item 12 of 12.");
  assert.equal(text({ ...third, item: 1 }, "TAKEOFF"), "Taking off: item 1 of 12.");
  assert.equal(text({ count: 12, item: 12, is_finished: true }), "Finished: all 12 items.");
  assert.equal(text({ count: 0 }), "");
});
