import assert from "node:assert/strict";
import { test } from "node:test";
import { climbText } from "../../../../ground/up_ground/web/static/js/instruments/tapes.js";
import {
  switchMode,
  switchText,
} from "../../../../ground/up_ground/web/static/js/state/pilot_input.js";
import { lostText } from "../../../../ground/up_ground/web/static/js/shell.js";
import { alarmOf } from "../../../../ground/up_ground/web/static/js/state/alarm_level.js";

function store(texts, profile = null) {
  return { text: (path) => texts[path] ?? null, profile, alarms: [], aircraftState: "live" };
}

test("the switch says what its position selects, by the profile or by default", () => {
  assert.equal(switchText(store({ "arduino.switch": "high" })), "high: AUTO (default)");
  const profile = { switch: { low: "ACRO", middle: "RATE", high: "AUTO" } };
  const middle = store({ "arduino.switch": "middle" }, profile);
  assert.equal(switchText(middle), "middle: RATE");
  assert.equal(switchMode(middle), "RATE");
  assert.equal(switchText(store({ "arduino.switch": "toString" })), "toString");
  assert.equal(switchMode(store({ "arduino.switch": "toString" })), null);
  assert.equal(switchMode(store({}, profile)), null);
});

test("the climb of a glider has tenths, and always four figures at most", () => {
  assert.deepEqual(
    [0.34, -0.04, -9.94, 9.96, -12.4, 240, null].map(climbText),
    ["0.3", "0.0", "-9.9", "10", "-12", "99+", "--"],
  );
});

test("a server that is full is not one that is gone", () => {
  assert.match(lostText("16 pages", true), /\(16 pages\)/);
  assert.ok(!lostText("", false).includes("("));
  assert.match(lostText("ended", false), /\(ended\)/);
  const alarm = alarmOf(store({}), { isOpen: false, isFull: true });
  assert.deepEqual(alarm, { level: "alarm", text: "server full" });
});
