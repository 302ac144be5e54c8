import assert from "node:assert/strict";
import { test } from "node:test";

import {
  actingMode, boardModes, controllerText, modeReason, piModes,
} from "../../../../ground/up_ground/web/static/js/state/flight_mode.js";
import { FlightTimer } from "../../../../ground/up_ground/web/static/js/state/flight_timer.js";
import { NewestFrame } from "../../../../ground/up_ground/web/static/js/state/newest_frame.js";

function frame(data) {
  const store = new NewestFrame(() => 0);
  store.updateFrame({ data, beacon: 1, age_ms: 0 }, 0);
  return store;
}

test("the flight mode that acts is that of the Raspberry Pi while it flies", () => {
  const flight_control = { mode: "LOITER" };
  assert.equal(actingMode(frame({ flight_mode: "SETPOINT", flight_control })), "LOITER");
  assert.equal(actingMode(frame({ flight_mode: "OUTPUT", flight_control })), "LOITER");
  assert.equal(actingMode(frame({ flight_mode: "FBW", flight_control })), "FBW");
  assert.equal(actingMode(frame({ flight_mode: "OUTPUT", flight_control: { mode: null } })), "OUTPUT");
  assert.equal(actingMode(frame({})), null);
});

test("the pilot, the Arduino or the Raspberry Pi controls", () => {
  const controller = (flight_mode, mode = null, failsafe = false) =>
    controllerText(frame({ flight_mode, flight_control: { mode }, arduino: { failsafe } }));
  assert.equal(controller("ACRO"), "the pilot");
  assert.equal(controller("FBW"), "the pilot; the Arduino holds the attitude");
  assert.equal(controller("OUTPUT", "ACRO"), "the pilot");
  assert.equal(controller("OUTPUT", "FBW"), "the pilot; the Raspberry Pi holds the attitude");
  assert.equal(controller("OUTPUT", "LOITER"), "Raspberry Pi");
  assert.equal(controller("SETPOINT", "RETURN"), "Raspberry Pi; the Arduino holds the attitude");
  assert.equal(controller("FBW", null, true), "Arduino (failsafe)");
  assert.equal(controller("SETPOINT", "RETURN", true), "Raspberry Pi; the Arduino holds the attitude");
  assert.equal(controller("constructor"), "");
});

test("the lists of modes are the aircraft's, bounded", () => {
  const modes = { AUTO: null, RETURN: "navigation", LOITER: 7 };
  const store = frame({ flight_control: { modes, board_modes: ["FBW"] } });
  assert.deepEqual([...piModes(store)], [["AUTO", null], ["RETURN", "navigation"], ["LOITER", "7"]]);
  assert.deepEqual(boardModes(store), ["FBW"]);
  for (const wrong of [null, 3, ["RETURN"]]) {
    assert.equal(piModes(frame({ flight_control: { modes: wrong } })), null);
  }
  assert.deepEqual(boardModes(frame({})), ["RATE", "FBW"]);
  const many = Object.fromEntries(Array.from({ length: 100 }, (_, index) => [`M${index}${"x".repeat(50)}`, null]));
  const bounded = [...piModes(frame({ flight_control: { modes: many } })).keys()];
  assert.equal(bounded.length, 32);
  assert.ok(bounded.every((name) => name.length === 24));
});

test("a reason is in words, an unknown code as it is", () => {
  assert.notEqual(modeReason("navigation"), "navigation");
  assert.notEqual(modeReason("mode_refused"), "mode_refused");
  assert.equal(modeReason("sonar"), "sonar");
  assert.equal(modeReason("toString"), "toString");
});

test("the flight's time begins with arming, or when the page first saw the flight", () => {
  const timer = new FlightTimer();
  const store = { flags: {}, events: [], flight_s: 10, flag: (name) => store.flags[name] ?? null };
  assert.equal(timer.update(store), null);
  store.flags = { armed: true, in_flight: true };
  assert.deepEqual(timer.update(store), { time_s: 0, isExact: false });
  store.flight_s = 15;
  assert.deepEqual(timer.update(store), { time_s: 5, isExact: false });
  store.events = [{ code: "disarmed", at_s: 1 }, { code: "armed", at_s: 4 }, { code: "mode", at_s: 9 }];
  assert.deepEqual(timer.update(store), { time_s: 11, isExact: true });
  store.flags = { armed: false, in_flight: false };
  assert.equal(timer.update(store), null);
  // A glider without motor is never armed.
  store.flags = { armed: false, in_flight: true };
  store.flight_s = 20;
  assert.deepEqual(timer.update(store), { time_s: 0, isExact: false });
  // A jump back in a replay.
  store.flight_s = 8;
  assert.deepEqual(timer.update(store), { time_s: 0, isExact: false });
});
