import assert from "node:assert/strict";
import { test } from "node:test";
import { Bell } from "../../../../ground/up_ground/web/static/js/sound.js";
import {
  acknowledge,
  alarmOf,
  allAlarms,
  dropAcknowledged,
  soundingAlarms,
  worstLevel,
} from "../../../../ground/up_ground/web/static/js/state/alarm_level.js";
import { Fleet } from "../../../../ground/up_ground/web/static/js/state/fleet.js";

const OPEN = { isOpen: true };
const FAILSAFE = { kind: "failsafe", level: "alarm", text: "Failsafe" };
const BATTERY = { kind: "battery", level: "warning", text: "Battery at 18 %" };

function store(alarms = [], aircraftState = "live") {
  return { alarms, aircraftState };
}

test("the worst level counts, an unknown one does not", () => {
  assert.equal(worstLevel([]), "none");
  assert.equal(worstLevel([BATTERY, FAILSAFE]), "alarm");
  assert.equal(worstLevel([{ level: "strange" }, null]), "none");
});

test("only a live aircraft is shown without alarm", () => {
  assert.deepEqual(alarmOf(store(), OPEN), { level: "none", text: "none" });
  assert.deepEqual(alarmOf(store([], "none"), OPEN), { level: "none", text: null });
});

test("the page itself detects silence and a lost server", () => {
  assert.deepEqual(alarmOf(store([], "silent"), OPEN), { level: "alarm", text: "silent" });
  assert.deepEqual(alarmOf(store([BATTERY], "silent"), OPEN), { level: "alarm", text: "silent" });
  assert.deepEqual(alarmOf(store(), { isOpen: false }), { level: "alarm", text: "no server" });
});

test("one alarm is named, several are counted", () => {
  assert.equal(alarmOf(store([FAILSAFE, BATTERY]), OPEN).text, "failsafe");
  assert.equal(alarmOf(store([FAILSAFE, { kind: "imu", level: "alarm" }]), OPEN).text, "2 alarms");
});

test("the bell rings once for a warning, and again every six seconds for an alarm", () => {
  const bell = new Bell();
  const ring = (alarms, now_s) => bell.ring(alarmOf(store(alarms), OPEN), alarms, now_s);
  assert.equal(ring([], 0), null);
  assert.equal(ring([BATTERY], 1), "warning");
  assert.equal(ring([BATTERY], 20), null);
  assert.equal(ring([BATTERY, FAILSAFE], 21), "alarm");
  assert.equal(ring([BATTERY, FAILSAFE], 26.9), null);
  assert.equal(ring([BATTERY, FAILSAFE], 27), "alarm");
  assert.equal(ring([BATTERY], 28), null);
  assert.equal(ring([], 29), null);
  assert.equal(ring([BATTERY], 30), "warning");
});

test("the bell rings when the aircraft falls silent", () => {
  const bell = new Bell();
  assert.equal(bell.ring(alarmOf(store(), OPEN), [], 0), null);
  assert.equal(bell.ring(alarmOf(store([], "silent"), OPEN), [], 1), "alarm");
  assert.equal(bell.ring(alarmOf(store([], "silent"), OPEN), [], 2), null);
});

test("an acknowledged alarm is silent, of every aircraft, until it is over", () => {
  const fleet = new Fleet(() => 0);
  const row = (name, ...alarms) => ({ name, alarms });
  fleet.take({ aircraft: [row("one", FAILSAFE), row("two", BATTERY)] }, 0);
  const both = { ...store([FAILSAFE]), aircraft: "one", fleet };
  const levels = () => {
    const { alarm, all } = soundingAlarms(both, OPEN);
    return [alarm.level, ...all.map((each) => each.aircraft)];
  };
  assert.deepEqual(levels(), ["alarm", "one", "two"]);
  // The same kind of alarm of another aircraft is another alarm.
  acknowledge({ ...FAILSAFE, aircraft: "two" });
  assert.deepEqual(levels(), ["alarm", "one", "two"]);
  acknowledge({ ...FAILSAFE, aircraft: "one" });
  dropAcknowledged(allAlarms(both));
  assert.deepEqual(levels(), ["warning", "two"]);
  acknowledge({ ...BATTERY, aircraft: "two" });
  assert.deepEqual(levels(), ["none"]);
  assert.equal(soundingAlarms(both, { isOpen: false }).alarm.text, "no server");
  assert.equal(soundingAlarms({ ...both, aircraftState: "silent", alarms: [] }, OPEN).alarm.text, "silent");
  dropAcknowledged([]);
  assert.deepEqual(levels(), ["alarm", "one", "two"]);
});
